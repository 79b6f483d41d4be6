// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One frame for the page, in one binary WebSocket message. The page's side of it: page/src/frame.ts.
//
// Everything is little-endian, and every part starts at a multiple of 4 bytes (zeros between):
//   char[4]  "GVF1"
//   uint32   json_bytes, points, segmentation_points
//   uint32   flags: 1 the points have colours
//   int64    serial: of the frames of this server, growing; what the page acknowledges
//   float32  origin[3], step [m]        of the points: position = origin + step * (x, y, z)
//   float32  origin[3], step [m]        of the segmentation's points
//   char     json[json_bytes]           UTF-8
//   uint16   x, y, z for each point
//   uint8    r, g, b for each point     with flag 1
//   uint16   x, y, z, segment, flags for each point of the segmentation, as in segmentation_t
// The JSON object: channel, utime, seq, frame_name (of all positions), cloud_frame_name, camera: {position,
// orientation} (the cloud's frame in that one; quaternion w, x, y, z), viewpoint, points_in (of the message),
// and, where they came, list (handle_list_t as graspd-listen writes it) and segmentation {voxel_size,
// support_plane, segments}.
#pragma once
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "client/view/frame_matcher.hpp"
#include "service/transport/refusal.hpp"

namespace graspd {

struct FrameMessageOptions {
  std::size_t max_points = 400'000;  ///< of larger clouds every second, third, ... point
  DecodeLimits limits;
};

/// T_target_cloud: to the frame of the list. A refusal where the cloud cannot be read.
[[nodiscard]] std::variant<std::string, Refusal> make_frame_message(const MatchedFrame& frame,
                                                                    std::int64_t serial,
                                                                    const Eigen::Isometry3f& T_target_cloud,
                                                                    const FrameMessageOptions& options);

}  // namespace graspd
