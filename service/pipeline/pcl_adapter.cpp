// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/pcl_adapter.hpp"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <cstdint>

namespace graspd {
namespace {

/// The shape of an organized cloud, where it is one of n points.
bool is_shape_of(std::size_t n, std::size_t width, std::size_t height) {
  return width * height == n;
}

}  // namespace

template <typename PointT>
PointCloud from_pcl(const pcl::PointCloud<PointT>& cloud) {
  PointCloud result;
  result.resize(cloud.points.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const PointT& p = cloud.points[i];
    result.x[i] = p.x;
    result.y[i] = p.y;
    result.z[i] = p.z;
  }
  const bool organized = is_shape_of(result.size(), cloud.width, cloud.height);
  result.width = static_cast<int>(organized ? cloud.width : result.size());
  result.height = organized ? static_cast<int>(cloud.height) : 1;
  result.viewpoint = cloud.sensor_origin_.template head<3>();
  return result;
}

template PointCloud from_pcl(const pcl::PointCloud<pcl::PointXYZ>&);
template PointCloud from_pcl(const pcl::PointCloud<pcl::PointXYZI>&);
template PointCloud from_pcl(const pcl::PointCloud<pcl::PointXYZL>&);
template PointCloud from_pcl(const pcl::PointCloud<pcl::PointXYZRGB>&);
template PointCloud from_pcl(const pcl::PointCloud<pcl::PointXYZRGBA>&);
template PointCloud from_pcl(const pcl::PointCloud<pcl::PointNormal>&);
template PointCloud from_pcl(const pcl::PointCloud<pcl::PointXYZINormal>&);
template PointCloud from_pcl(const pcl::PointCloud<pcl::PointXYZRGBNormal>&);

pcl::PointCloud<pcl::PointXYZ> to_pcl(const PointCloud& cloud) {
  pcl::PointCloud<pcl::PointXYZ> result;
  result.points.reserve(cloud.size());
  result.is_dense = true;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    result.points.emplace_back(cloud.x[i], cloud.y[i], cloud.z[i]);
    result.is_dense = result.is_dense && cloud.point(i).allFinite();
  }
  const auto width = static_cast<std::size_t>(cloud.width), height = static_cast<std::size_t>(cloud.height);
  const bool organized = is_shape_of(cloud.size(), width, height);
  result.width = static_cast<std::uint32_t>(organized ? width : cloud.size());
  result.height = organized ? static_cast<std::uint32_t>(height) : 1;
  result.sensor_origin_ << cloud.viewpoint, 0;
  return result;
}

}  // namespace graspd
