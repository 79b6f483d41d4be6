// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// How many events of each channel stand where in an archive: finds a frame by its number.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "client/replay/archive.hpp"

namespace graspd {

/// Belongs to logs of certain names and sizes. Which channels have frames is the configuration's matter: the
/// index serves any. Takes a few bytes for each 16 MB of the logs, and a bounded number of them.
class FrameIndex {
 public:
  /// Reads the headers of all events. Throws EventLogError, also for more than 10,000 channels.
  explicit FrameIndex(const std::vector<LogPart>& logs);

  /// Nothing when there is no file, or it is of other logs. Throws std::runtime_error for what is no index.
  [[nodiscard]] static std::optional<FrameIndex> load(const std::filesystem::path& file,
                                                      const std::vector<LogPart>& logs);
  /// Throws std::runtime_error.
  void save(const std::filesystem::path& file) const;

  /// The logs, shorter: with all events from behind frame first - 1 up to frame end - 1.
  struct Stretch {
    std::vector<LogPart> parts;
    std::int64_t frames_before = 0;  ///< frames that stand before the first event that is left
  };
  [[nodiscard]] Stretch stretch(std::int64_t first_frame, std::int64_t end_frame,
                                const std::function<bool(const std::string& channel)>& has_frames) const;

 private:
  FrameIndex() = default;

  /// The events from a place up to the next block's.
  struct Block {
    std::size_t log = 0;
    std::int64_t begin = 0;            // [bytes]
    std::vector<std::int64_t> events;  // by channel; those that are missing at the end: 0
  };
  struct Log {
    std::string path;
    std::int64_t bytes = 0;
    bool operator==(const Log&) const = default;
  };

  [[nodiscard]] static std::vector<Log> identified(const std::vector<LogPart>& logs);
  void add(std::size_t log, const EventHead& head, std::int64_t& block_bytes);
  void coarsen();
  [[nodiscard]] bool plausible() const;

  std::vector<LogPart> parts_;
  std::vector<Log> logs_;
  std::vector<std::string> channels_;
  std::vector<Block> blocks_;
};

}  // namespace graspd
