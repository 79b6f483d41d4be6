// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/bench/pcl_baseline.hpp"

#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/region_growing.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

namespace graspd {
namespace {

using Clock = std::chrono::steady_clock;
using Tree = pcl::search::KdTree<pcl::PointXYZ>;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

pcl::PointCloud<pcl::PointXYZ>::Ptr to_pcl(const PointCloud& cloud) {
  pcl::PointCloud<pcl::PointXYZ>::Ptr points(new pcl::PointCloud<pcl::PointXYZ>);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud.point(i).allFinite()) points->emplace_back(cloud.x[i], cloud.y[i], cloud.z[i]);
  return points;
}

}  // namespace

PclTimes run_pcl(const PointCloud& cloud, float radius_m, float max_angle_deg, int threads) {
  const pcl::PointCloud<pcl::PointXYZ>::Ptr points = to_pcl(cloud);
  PclTimes times;
  const auto start = Clock::now();
  Tree::Ptr tree(new Tree);
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation(static_cast<unsigned>(threads));
  estimation.setInputCloud(points);
  estimation.setSearchMethod(tree);
  estimation.setRadiusSearch(radius_m);
  estimation.setViewPoint(cloud.viewpoint.x(), cloud.viewpoint.y(), cloud.viewpoint.z());
  pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  estimation.compute(*normals);
  times.normals_ms = ms_since(start);

  const auto grown_from = Clock::now();
  pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
  growing.setInputCloud(points);
  growing.setInputNormals(normals);
  growing.setSearchMethod(tree);
  growing.setNumberOfNeighbours(30);
  growing.setSmoothnessThreshold(max_angle_deg * std::numbers::pi_v<float> / 180);
  growing.setCurvatureThreshold(std::numeric_limits<float>::max());
  growing.setMinClusterSize(40);
  std::vector<pcl::PointIndices> regions;
  growing.extract(regions);
  times.region_growing_ms = ms_since(grown_from);
  times.num_regions = static_cast<int>(regions.size());
  return times;
}

}  // namespace graspd
