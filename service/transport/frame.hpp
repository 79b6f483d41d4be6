// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One decoded frame of a depth sensor, whatever type it came as.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <string>

#include "service/pipeline/point_cloud.hpp"

namespace graspd {

/// What an answer repeats of its cloud. The defaults stand for what could not be read.
struct FrameHeader {
  std::int64_t utime = 0;       ///< time of capture [us], any epoch
  std::int64_t seq = -1;        ///< frame counter of the source
  std::pmr::string frame_name;  ///< coordinate frame of the points
};

struct Frame {
  std::int64_t utime = 0;
  std::int64_t seq = -1;
  std::pmr::string frame_name;
  PointCloud cloud;
};

}  // namespace graspd
