// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What of an archive has to be read for a range of times.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "client/log/time_search.hpp"
#include "client/replay/archive.hpp"

namespace graspd {

/// Every log is searched by itself: they may overlap in time and stand in any order. Remembers where it has
/// looked. Throws EventLogError for logs that cannot be read.
class ArchiveSearch {
 public:
  explicit ArchiveSearch(const std::vector<LogPart>& parts, const TimeSearchConfig& config = {});

  /// The same parts, shorter: every event with a time in [from, to) [us] is in them still.
  [[nodiscard]] std::vector<LogPart> stretch(std::int64_t from_utime, std::int64_t to_utime);

  /// The same parts without events that stand before the first one at or after a time [us].
  [[nodiscard]] std::vector<LogPart> rest(std::int64_t from_utime);

  /// A line for each log that is read whole because times go backwards in it.
  [[nodiscard]] std::vector<std::string> notes() const;

 private:
  std::vector<LogPart> parts_;
  std::vector<TimeSearch> searches_;  // of the parts
};

/// That the parts have between them.
[[nodiscard]] std::int64_t total_bytes(const std::vector<LogPart>& parts);

}  // namespace graspd
