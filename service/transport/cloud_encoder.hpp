// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Clouds and depth images -> messages, for clients and tests.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "graspd/depth_image_t.hpp"
#include "graspd/point_cloud_t.hpp"
#include "service/pipeline/point_cloud.hpp"
#include "service/transport/frame.hpp"

namespace graspd {

/// Packs x, y, z and, where given, rgb (0x00RRGGBB) and label: either empty or one a point. Throws
/// std::invalid_argument when the lengths differ.
[[nodiscard]] point_cloud_t make_point_cloud(const FrameHeader& header, const PointCloud& cloud,
                                             std::span<const std::uint32_t> rgb = {},
                                             std::span<const std::uint32_t> label = {});

/// A pinhole depth camera, without distortion.
struct DepthCamera {
  int width = 0;                          ///< [pixels]
  int height = 0;                         ///< [pixels]
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< [pixels]
  double depth_scale_m = 0.001;           ///< of one unit of depth [m]
};

/// depth: row by row, 0 where nothing was measured. Throws std::invalid_argument unless there is one value a
/// pixel.
[[nodiscard]] depth_image_t make_depth_image(const FrameHeader& header, const DepthCamera& camera,
                                             std::span<const std::uint16_t> depth);

/// The message, fingerprint first. Throw std::invalid_argument when a num_ or _size member is not the length
/// of its array. The second form reuses the buffer's memory.
[[nodiscard]] std::vector<std::byte> encode(const point_cloud_t& cloud);
[[nodiscard]] std::vector<std::byte> encode(const depth_image_t& image);
void encode(const point_cloud_t& cloud, std::vector<std::byte>& buffer);
void encode(const depth_image_t& image, std::vector<std::byte>& buffer);

}  // namespace graspd
