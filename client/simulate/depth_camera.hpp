// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A pinhole depth camera that looks at a scene by casting a ray through each pixel.
#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "client/common/cloud_file.hpp"
#include "client/common/pinhole.hpp"
#include "client/simulate/scene.hpp"

namespace graspd {

/// One image, row by row. Pixels that see nothing have depth 0 and label kLabelInvalid.
struct DepthFrame {
  Pinhole camera;
  std::vector<float> depth_m;  ///< along the optical axis
  std::vector<std::uint32_t> label;
  std::vector<std::uint32_t> rgb;    ///< 0x00RRGGBB, shaded
  std::vector<float> cos_incidence;  ///< between the ray and the surface's normal [0, 1]

  [[nodiscard]] std::size_t size() const { return depth_m.size(); }
};

/// The optical frame: x right, y down, z forward.
[[nodiscard]] Eigen::Isometry3d look_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target);

/// What an ideal camera sees.
[[nodiscard]] DepthFrame render(const Scene& scene, const Pinhole& camera,
                                const Eigen::Isometry3d& T_world_camera);

/// In the optical frame, organized, viewpoint at the origin; missing points are NaN.
[[nodiscard]] LabelledCloud to_cloud(const DepthFrame& frame);

}  // namespace graspd
