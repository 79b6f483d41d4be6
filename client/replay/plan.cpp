// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/plan.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "client/common/read_file.hpp"
#include "client/common/replace_file.hpp"
#include "client/common/text.hpp"
#include "client/replay/effective_config.hpp"
#include "service/transport/seal.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

using nlohmann::json;

/// Events that stay together.
struct Block {
  std::size_t log = 0;
  std::int64_t begin = 0;  ///< of its first frame [bytes]
  std::int64_t frames = 0;
  std::int64_t work = 0;
};

constexpr std::size_t kMostBlocks = 1 << 20;

/// Twice as much in each block: however long the logs are, the list is not.
void coarsen(std::vector<Block>& blocks) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < blocks.size(); i += 2, ++kept) {
    Block block = blocks[i];
    if (i + 1 < blocks.size()) {
      block.frames += blocks[i + 1].frames;
      block.work += blocks[i + 1].work;
    }
    blocks[kept] = block;
  }
  blocks.resize(kept);
}

std::int64_t estimated_points(Archive& archive, const EventHead& head) {
  constexpr std::int64_t kDepthBytes = 2, kPointBytes = 16;
  // In a signed message the inner one begins where its signature's head ends.
  constexpr std::size_t kSealHead = kSealBytes - kMacBytes;
  std::vector<std::byte> start;
  archive.read_message(start, kSealHead + kFingerprintBytes);
  const bool sealed = fingerprint(start) == kSealedFingerprint && start.size() >= kSealHead;
  const bool depth = fingerprint(std::span(start).subspan(sealed ? kSealHead : 0)) == kDepthImageFingerprint;
  const std::int64_t bytes = head.size - (sealed ? static_cast<std::int64_t>(kSealBytes) : 0);
  return std::max<std::int64_t>(1, bytes / (depth ? kDepthBytes : kPointBytes));
}

std::vector<Block> find_blocks(const std::vector<LogPart>& parts, ChannelTable& channels) {
  std::vector<Block> blocks;
  Archive archive(parts);
  EventHead head;
  std::int64_t frames_a_block = 1;
  while (archive.next_head(head)) {
    if (!channels.find(head.channel).processor) continue;
    if (blocks.empty() || blocks.back().frames >= frames_a_block) {
      if (blocks.size() >= kMostBlocks) {
        coarsen(blocks);
        frames_a_block *= 2;
      }
      blocks.push_back({archive.part(), head.position, 0, 0});
    }
    ++blocks.back().frames;
    blocks.back().work += estimated_points(archive, head);
  }
  return blocks;
}

/// Where shards begin, as indices of blocks; the first is 0.
std::vector<std::size_t> cuts(const std::vector<Block>& blocks, std::size_t shards) {
  std::int64_t all = 0;
  for (const Block& block : blocks) all += block.work;
  std::vector<std::size_t> begins{0};
  std::int64_t done = 0;
  for (std::size_t i = 0; i < blocks.size() && begins.size() < shards; ++i) {
    const auto due =
        static_cast<double>(begins.size()) * static_cast<double>(all) / static_cast<double>(shards);
    // Never fewer blocks than shards that are still to come.
    const bool last_chance = blocks.size() - i == shards - begins.size();
    if (i > begins.back() && (static_cast<double>(done) >= due || last_chance)) begins.push_back(i);
    done += blocks[i].work;
  }
  return begins;
}

/// Everything from one place in the logs up to another.
std::vector<LogPart> stretch(const Plan& plan, std::size_t log, std::int64_t begin, std::size_t end_log,
                             std::int64_t end) {
  std::vector<LogPart> parts;
  for (std::size_t i = log; i <= end_log && i < plan.logs.size(); ++i) {
    const LogPart part{plan.logs[i], {i == log ? begin : 0, i == end_log ? end : plan.log_bytes[i]}};
    if (part.part.begin < part.part.end) parts.push_back(part);
  }
  return parts;
}

json to_json(const Plan& plan) {
  json shards = json::array(), logs = json::array();
  for (std::size_t i = 0; i < plan.logs.size(); ++i)
    logs.push_back({{"path", plan.logs[i].string()}, {"bytes", plan.log_bytes[i]}});
  for (const Shard& shard : plan.shards) {
    json parts = json::array();
    for (const LogPart& part : shard.parts)
      parts.push_back({{"path", part.path.string()}, {"begin", part.part.begin}, {"end", part.part.end}});
    shards.push_back({{"frames", shard.frames}, {"parts", parts}});
  }
  return {{"graspd", GRASPD_VERSION},
          {"keep", plan.keep},
          {"frames", plan.frames},
          {"logs", logs},
          {"shards", shards}};
}

Plan plan_from(const json& j) {
  Plan plan;
  j.at("keep").get_to(plan.keep);
  j.at("frames").get_to(plan.frames);
  for (const json& log : j.at("logs")) {
    plan.logs.emplace_back(log.at("path").get<std::string>());
    plan.log_bytes.push_back(log.at("bytes").get<std::int64_t>());
  }
  for (const json& entry : j.at("shards")) {
    Shard& shard = plan.shards.emplace_back();
    entry.at("frames").get_to(shard.frames);
    for (const json& part : entry.at("parts"))
      shard.parts.push_back({part.at("path").get<std::string>(),
                             {part.at("begin").get<std::int64_t>(), part.at("end").get<std::int64_t>()}});
  }
  return plan;
}

void expect_same_logs(const Plan& plan) {
  std::error_code error;
  for (std::size_t i = 0; i < plan.logs.size(); ++i) {
    const auto size = std::filesystem::file_size(plan.logs[i], error);
    if (error) throw std::runtime_error(plan.logs[i].string() + ": cannot be read: " + error.message());
    if (static_cast<std::int64_t>(size) != plan.log_bytes[i])
      throw std::runtime_error(plan.logs[i].string() + ": has changed since it was planned");
  }
}

}  // namespace

Plan make_plan(const std::vector<std::filesystem::path>& logs, const ServiceConfig& service,
               const std::string& keep, std::size_t shards) {
  Plan plan;
  plan.keep = keep;
  std::vector<LogPart> parts;
  for (const auto& log : logs) {
    plan.logs.push_back(std::filesystem::absolute(log));
    plan.log_bytes.push_back(EventLogReader(log).size());
    parts.push_back({plan.logs.back()});
  }
  const SystemClock clock;
  ChannelTable channels(service, keep, clock);
  const std::vector<Block> blocks = find_blocks(parts, channels);
  const std::vector<std::size_t> begins =
      cuts(blocks, std::min(shards, std::max<std::size_t>(1, blocks.size())));
  for (std::size_t s = 0; s < begins.size(); ++s) {
    const bool last = s + 1 == begins.size();
    const std::size_t end = last ? blocks.size() : begins[s + 1];
    Shard shard;
    for (std::size_t i = begins[s]; i < end; ++i) shard.frames += blocks[i].frames;
    const Block from = s == 0 ? Block{} : blocks[begins[s]];
    shard.parts = last ? stretch(plan, from.log, from.begin, plan.logs.size(), 0)
                       : stretch(plan, from.log, from.begin, blocks[end].log, blocks[end].begin);
    plan.frames += shard.frames;
    plan.shards.push_back(std::move(shard));
  }
  return plan;
}

void save_plan(const std::filesystem::path& folder, const Plan& plan, const ServiceConfig& service) {
  std::filesystem::create_directories(folder / "shards");
  const std::string text = to_json(plan).dump(1) + '\n', config = effective_config(service);
  const bool there = std::filesystem::exists(folder / "plan.json");
  if (there && (read_file(folder / "plan.json") != text || read_file(folder / "config.yaml") != config))
    throw std::runtime_error(folder.string() + ": holds another plan");
  if (there) return;
  replace_file(folder / "config.yaml", config);
  replace_file(folder / "plan.json", text);
}

Plan load_plan(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "plan.json";
  const json content = json::parse(read_file(file), nullptr, false);
  try {
    Plan plan = plan_from(content);
    expect_same_logs(plan);
    return plan;
  } catch (const json::exception&) {
    throw std::runtime_error(file.string() + ": not a plan");
  }
}

ReplayConfig shard_config(const std::filesystem::path& folder, const Plan& plan, std::size_t shard) {
  ReplayConfig config;
  config.service = load_replay_config((folder / "config.yaml").string(), "", "");
  config.parts = plan.shards.at(shard).parts;
  config.keep = plan.keep;
  return config;
}

std::filesystem::path shard_log(const std::filesystem::path& folder, std::size_t shard) {
  return folder / "shards" / printed("%06zu.log", shard);
}

}  // namespace graspd
