// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/reading.hpp"

#include <limits>

#include "client/common/text.hpp"
#include "client/replay/archive_search.hpp"
#include "client/replay/frame_index.hpp"

namespace graspd {
namespace {

FrameIndex kept_index(const std::string& file, const std::vector<LogPart>& logs,
                      std::vector<std::string>& notes) {
  if (auto index = FrameIndex::load(file, logs)) return std::move(*index);
  FrameIndex index(logs);
  index.save(file);
  notes.push_back(file + ": index of the frames written");
  return index;
}

}  // namespace

std::vector<std::string> find_reading(ReplayConfig& config, const PlaceOptions& options) {
  const Selection &selection = config.selection, all;
  const bool by_frame = selection.first_frame > 0 || selection.end_frame != all.end_frame;
  const bool by_time = selection.from_utime != all.from_utime || selection.to_utime != all.to_utime;
  std::vector<std::string> notes;
  if (by_frame && !options.index_file.empty()) {
    const FrameIndex index = kept_index(options.index_file, config.parts, notes);
    const SystemClock clock;
    ChannelTable channels(config.service, "", clock);
    auto found = index.stretch(selection.first_frame, selection.end_frame, [&](const std::string& channel) {
      return channels.find(channel).processor != nullptr;
    });
    config.reading = std::move(found.parts);
    config.frames_before = found.frames_before;
  } else if (by_time && !by_frame && !options.scan) {
    ArchiveSearch search(config.parts);
    config.reading = search.stretch(selection.from_utime, selection.to_utime);
    notes = search.notes();
  }
  if (config.reading.empty()) return notes;
  notes.push_back(printed("%.1f of %.1f MB are looked at",
                          1e-6 * static_cast<double>(total_bytes(config.reading)),
                          1e-6 * static_cast<double>(total_bytes(config.parts))));
  return notes;
}

}  // namespace graspd
