// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Event logs of random events, and what reading all of them gives.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "client/replay/archive.hpp"
#include "client/simulate/rng.hpp"
#include "tests/support/temp_folder.hpp"

namespace graspd {

struct RandomLogConfig {
  int events = 200;
  std::int64_t start_utime = 0;
  std::int64_t most_step_us = 2'000'000;  ///< from one event to the next
  std::int64_t most_early_us = 0;         ///< events may carry a time that is so much too early
  std::size_t most_bytes = 3000;          ///< of a message
  int damages = 0;                        ///< places with rubbish, lost bytes or a broken sync word
};

/// Time of the last event.
std::int64_t write_random_log(const std::filesystem::path& path, Rng& rng, const RandomLogConfig& config);

/// (log, start in it, time, channel).
using FoundEvent = std::tuple<std::string, std::int64_t, std::int64_t, std::string>;

/// Events of the parts with times in [from, to).
[[nodiscard]] std::vector<FoundEvent> events_between(const std::vector<LogPart>& parts, std::int64_t from,
                                                     std::int64_t to);

[[nodiscard]] std::int64_t bytes_of_parts(const std::vector<LogPart>& parts);

}  // namespace graspd
