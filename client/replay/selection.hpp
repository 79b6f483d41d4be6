// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Which frames of an archive are worked on.
#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "client/replay/archive.hpp"

namespace graspd {

/// Half-open ranges: of times [us] since 1970, and of frames, counted from 0 over all clouds of all sources.
struct Selection {
  std::int64_t from_utime = std::numeric_limits<std::int64_t>::min();
  std::int64_t to_utime = std::numeric_limits<std::int64_t>::max();
  std::int64_t first_frame = 0;
  std::int64_t end_frame = std::numeric_limits<std::int64_t>::max();

  [[nodiscard]] bool has_time(std::int64_t utime) const { return utime >= from_utime && utime < to_utime; }
  [[nodiscard]] bool has_frame(std::int64_t frame) const { return frame >= first_frame && frame < end_frame; }
};

/// Times are seconds since the first event of the first log, or with an @ before them seconds since 1970;
/// frames are A:B, A: or :B. Empty: everything. Throws ConfigError that names the option.
[[nodiscard]] Selection parse_selection(const std::string& from, const std::string& to,
                                        const std::string& frames, const std::vector<LogPart>& parts);

}  // namespace graspd
