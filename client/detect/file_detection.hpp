// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A cloud from a file -> the handle list that the daemon would answer it with.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <string>
#include <vector>

#include "graspd/handle_list_t.hpp"
#include "service/config/source_config.hpp"
#include "service/pipeline/point_cloud.hpp"
#include "service/pipeline/segment_report.hpp"

namespace graspd {

struct FileDetection {
  handle_list_t list;
  std::pmr::vector<SegmentReport> segments;  ///< what became of each; centroids in the frame of the handles
};

/// Handles, statuses and counts are those of the daemon with the same settings, to the bit; the calling
/// thread's oneTBB arena does the work. frame_name goes into the list, also where the sensor's pose moves
/// handles to another frame: it tells the file.
[[nodiscard]] FileDetection detect_in_cloud(const PointCloud& cloud, const std::string& frame_name,
                                            std::int64_t seq, const SourceConfig& source);

/// One line: counts, failures by reason, stage times; no newline.
[[nodiscard]] std::string detection_stats(const handle_list_t& list);

}  // namespace graspd
