// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/source_config.hpp"

#include <cmath>

namespace graspd {

Eigen::Isometry3f SensorPose::T_target_cloud() const {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  if (quaternion_wxyz.size() == 4) {
    rotation =
        Eigen::Quaterniond(quaternion_wxyz[0], quaternion_wxyz[1], quaternion_wxyz[2], quaternion_wxyz[3]);
    rotation.normalize();
  } else if (rpy_rad.size() == 3) {
    rotation = Eigen::AngleAxisd(rpy_rad[2], Eigen::Vector3d::UnitZ()) *
               Eigen::AngleAxisd(rpy_rad[1], Eigen::Vector3d::UnitY()) *
               Eigen::AngleAxisd(rpy_rad[0], Eigen::Vector3d::UnitX());
  }
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.linear() = rotation.toRotationMatrix().cast<float>();
  T.translation() = position_m;
  return T;
}

std::optional<ConfigProblem> SensorPose::validate() const {
  if (!quaternion_wxyz.empty() && quaternion_wxyz.size() != 4)
    return ConfigProblem{"quaternion_wxyz", "not a quaternion: expected w, x, y, z"};
  if (!rpy_rad.empty() && rpy_rad.size() != 3)
    return ConfigProblem{"rpy_rad", "not three angles: expected roll, pitch, yaw"};
  if (!quaternion_wxyz.empty() && !rpy_rad.empty())
    return ConfigProblem{"rpy_rad", "the rotation is given twice: expected quaternion_wxyz or rpy_rad"};
  double norm2 = 0;
  for (const double c : quaternion_wxyz) norm2 += c * c;
  // Rounded components are welcome, other numbers are a mistake.
  if (!quaternion_wxyz.empty() && std::abs(std::sqrt(norm2) - 1) > 0.01)
    return ConfigProblem{"quaternion_wxyz", "not a rotation: expected unit length"};
  const bool moved = !position_m.isZero(0) || !quaternion_wxyz.empty() || !rpy_rad.empty();
  if (frame_name.empty() && moved)
    return ConfigProblem{"frame_name",
                         "a pose is given in no frame: expected the name of the frame it is in"};
  return std::nullopt;
}

std::optional<ConfigProblem> DegradeConfig::validate() const {
  if (below_ms >= above_ms) return ConfigProblem{"below_ms", "too large: expected less than above_ms"};
  return std::nullopt;
}

DetectConfig SourceConfig::degraded_detect() const {
  DetectConfig coarse = detect;
  const auto voxel_m = static_cast<float>(degrade.voxel_m);
  coarse.neighborhoods.radius_m *= voxel_m / detect.downsample.leaf_size_m;
  coarse.downsample.leaf_size_m = voxel_m;
  return coarse;
}

std::optional<ConfigProblem> SourceConfig::validate() const {
  const auto voxel_m = static_cast<float>(degrade.voxel_m);
  if (degrade.voxel_m > 0 && voxel_m <= detect.downsample.leaf_size_m)
    return ConfigProblem{"degrade.voxel_m", "not coarser: expected more than detect.downsample.leaf_size_m"};
  return std::nullopt;
}

}  // namespace graspd
