// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// From PCL's clouds to the pipeline's and back, for programs that use the pipeline in-process.
#pragma once
#include "service/pipeline/point_cloud.hpp"

namespace pcl {
template <typename PointT>
class PointCloud;
struct PointXYZ;
}  // namespace pcl

namespace graspd {

/// The coordinates of a PCL cloud [m], in the cloud's frame; PCL's sensor origin is the viewpoint. An
/// organized cloud stays organized, points that are not finite stay where they are. Where width * height is
/// not the number of points the cloud is taken as unorganized. There for pcl::PointXYZ, PointXYZI, PointXYZL,
/// PointXYZRGB, PointXYZRGBA, PointNormal, PointXYZINormal and PointXYZRGBNormal.
template <typename PointT>
[[nodiscard]] PointCloud from_pcl(const pcl::PointCloud<PointT>& cloud);

/// The same the other way; is_dense says whether every coordinate is finite. Where width * height is not the
/// number of points the result is unorganized.
[[nodiscard]] pcl::PointCloud<pcl::PointXYZ> to_pcl(const PointCloud& cloud);

}  // namespace graspd
