// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Two runs over the same clouds, frame by frame: logs of handle lists, or their tables.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "client/compare/distribution.hpp"
#include "client/compare/frame_difference.hpp"

namespace graspd {

struct Quantity {
  std::string name;  ///< with its unit
  Distribution before;
  Distribution after;
};

struct ComparedFrame {
  FrameDifference difference;
  handle_list_t before;
  handle_list_t after;
};

struct RunComparison {
  std::int64_t frames = 0;       ///< that both runs answered
  std::int64_t only_before = 0;  ///< answered by the first run alone
  std::int64_t only_after = 0;
  std::int64_t same = 0;  ///< frames with the same handles to the bit, as far as a table holds them
  std::int64_t worse = 0;
  std::int64_t better = 0;
  std::map<std::pair<std::string, std::string>, std::int64_t> statuses;  ///< (before, after) -> frames
  std::vector<Quantity> quantities;
  std::vector<ComparedFrame> worst;  ///< of the worse ones, the worst first
};

struct ComparisonOptions {
  std::size_t num_worst = 10;
  double tolerance = 0.05;  ///< net losses up to this are neither worse nor better
};

/// `on_frame` sees every difference, in the order of the second run. A file is a log, or the table of handles
/// that HandleTables has written; with a table numbers are the same when they are as floats. Keeps a place in
/// the file for each list of the first run, and the worst frames. Throws EventLogError, std::runtime_error.
[[nodiscard]] RunComparison compare_runs(const std::filesystem::path& before,
                                         const std::filesystem::path& after, const ComparisonOptions& options,
                                         const std::function<void(const FrameDifference&)>& on_frame);

}  // namespace graspd
