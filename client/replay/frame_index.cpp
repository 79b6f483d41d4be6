// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/frame_index.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "client/common/replace_file.hpp"

namespace graspd {
namespace {

using nlohmann::json;

constexpr std::int64_t kBlockBytes = 16 << 20;
constexpr std::size_t kMostBlocks = 1 << 17;
constexpr std::size_t kMostChannels = 10'000;
constexpr const char* kFormat = "graspd frame index 1";

void add_up(std::vector<std::int64_t>& sums, const std::vector<std::int64_t>& counts) {
  sums.resize(std::max(sums.size(), counts.size()));
  for (std::size_t i = 0; i < counts.size(); ++i) sums[i] += counts[i];
}

}  // namespace

std::vector<FrameIndex::Log> FrameIndex::identified(const std::vector<LogPart>& logs) {
  std::vector<Log> result;
  for (const LogPart& log : logs)
    result.push_back({std::filesystem::absolute(log.path).string(), EventLogReader(log.path).size()});
  return result;
}

FrameIndex::FrameIndex(const std::vector<LogPart>& logs) : parts_(logs), logs_(identified(logs)) {
  Archive archive(logs);
  EventHead head;
  std::int64_t block_bytes = kBlockBytes;
  while (archive.next_head(head)) add(archive.part(), head, block_bytes);
}

void FrameIndex::add(std::size_t log, const EventHead& head, std::int64_t& block_bytes) {
  if (blocks_.empty() || blocks_.back().log != log || head.position - blocks_.back().begin >= block_bytes) {
    if (blocks_.size() == kMostBlocks) {
      coarsen();
      block_bytes *= 2;
    }
    blocks_.push_back({log, head.position, {}});
  }
  const auto known = std::find(channels_.begin(), channels_.end(), head.channel);
  const auto channel = static_cast<std::size_t>(known - channels_.begin());
  if (known == channels_.end()) {
    if (channel == kMostChannels)
      throw EventLogError(logs_[log].path + ": no index can be made: more than 10,000 channels");
    channels_.push_back(head.channel);
  }
  std::vector<std::int64_t>& events = blocks_.back().events;
  if (events.size() <= channel) events.resize(channel + 1);
  ++events[channel];
}

void FrameIndex::coarsen() {
  std::vector<Block> coarse;
  for (std::size_t i = 0; i < blocks_.size(); i += 2) {
    coarse.push_back(std::move(blocks_[i]));
    if (i + 1 < blocks_.size()) add_up(coarse.back().events, blocks_[i + 1].events);
  }
  blocks_ = std::move(coarse);
}

FrameIndex::Stretch FrameIndex::stretch(std::int64_t first_frame, std::int64_t end_frame,
                                        const std::function<bool(const std::string&)>& has_frames) const {
  std::vector<bool> counts;
  for (const std::string& channel : channels_) counts.push_back(has_frames(channel));
  Stretch found{parts_, 0};
  std::size_t begin = 0, end = blocks_.size();
  std::int64_t frames = 0;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    if (frames < first_frame) {
      begin = i;
      found.frames_before = frames;
    }
    if (frames >= end_frame) {
      end = i;
      break;
    }
    for (std::size_t c = 0; c < blocks_[i].events.size(); ++c)
      if (counts[c]) frames += blocks_[i].events[c];
  }
  // What is no event before the first block or behind the last one still counts as damaged.
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    EventLogReader::Part& part = found.parts[i].part;
    part = {0, logs_[i].bytes};
    if (begin > 0 && i < blocks_[begin].log) part.begin = part.end;
    if (begin > 0 && i == blocks_[begin].log) part.begin = blocks_[begin].begin;
    if (end < blocks_.size() && i == blocks_[end].log) part.end = blocks_[end].begin;
    if (end < blocks_.size() && i > blocks_[end].log) part.end = part.begin;
  }
  return found;
}

void FrameIndex::save(const std::filesystem::path& file) const {
  json logs = json::array(), blocks = json::array();
  for (const Log& log : logs_) logs.push_back({log.path, log.bytes});
  for (const Block& block : blocks_) blocks.push_back({block.log, block.begin, block.events});
  const json content{{"format", kFormat}, {"logs", logs}, {"channels", channels_}, {"blocks", blocks}};
  replace_file(file, content.dump(-1, ' ', false, json::error_handler_t::replace) + '\n');
}

bool FrameIndex::plausible() const {
  const Block* previous = nullptr;
  for (const Block& block : blocks_) {
    if (block.log >= logs_.size() || block.begin < 0 || block.begin >= logs_[block.log].bytes) return false;
    if (block.events.size() > channels_.size()) return false;
    if (std::any_of(block.events.begin(), block.events.end(), [](std::int64_t n) { return n < 0; }))
      return false;
    const bool in_order = previous == nullptr || previous->log < block.log ||
                          (previous->log == block.log && previous->begin < block.begin);
    if (!in_order) return false;
    previous = &block;
  }
  return true;
}

std::optional<FrameIndex> FrameIndex::load(const std::filesystem::path& file,
                                           const std::vector<LogPart>& logs) {
  std::ifstream stream(file);
  if (!stream) return std::nullopt;
  const json content = json::parse(stream, nullptr, false);
  FrameIndex index;
  try {
    if (content.at("format") != kFormat)
      throw std::runtime_error(file.string() + ": an index of another version");
    for (const json& log : content.at("logs"))
      index.logs_.push_back({log.at(0).get<std::string>(), log.at(1).get<std::int64_t>()});
    content.at("channels").get_to(index.channels_);
    for (const json& block : content.at("blocks"))
      index.blocks_.push_back({block.at(0).get<std::size_t>(), block.at(1).get<std::int64_t>(),
                               block.at(2).get<std::vector<std::int64_t>>()});
  } catch (const json::exception&) {
    throw std::runtime_error(file.string() + ": not an index of frames");
  }
  if (!index.plausible()) throw std::runtime_error(file.string() + ": not an index of frames");
  if (index.logs_ != identified(logs)) return std::nullopt;
  index.parts_ = logs;
  return index;
}

}  // namespace graspd
