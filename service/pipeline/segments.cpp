// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/segments.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "service/pipeline/members.hpp"

namespace graspd {
namespace {

void set_axes(const PointCloud& cloud, Segment& segment) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : segment.points) mean += cloud.point(i).cast<double>();
  mean /= static_cast<double>(segment.points.size());
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (const std::uint32_t i : segment.points) {
    const Eigen::Vector3d d = cloud.point(i).cast<double>() - mean;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    xz += d.x() * d.z();
    yy += d.y() * d.y();
    yz += d.y() * d.z();
    zz += d.z() * d.z();
  }
  Eigen::Matrix3d covariance;
  covariance << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  segment.centroid = mean.cast<float>();
  segment.normal = solver.eigenvectors().col(0).cast<float>();
  if (segment.normal.dot(cloud.viewpoint - segment.centroid) < 0) segment.normal = -segment.normal;
  segment.major = solver.eigenvectors().col(2).cast<float>();
  segment.minor = segment.normal.cross(segment.major);
  const double squares = std::max(0.0, solver.eigenvalues()[0]);
  segment.scatter_m = static_cast<float>(std::sqrt(squares / static_cast<double>(segment.points.size())));
}

}  // namespace

Segments build_segments(const PointCloud& cloud, const Labels& labels, float leaf_size_m,
                        const SegmentsConfig& config) {
  const RawVector<std::uint32_t> labelled = members(labels.of_point);
  std::pmr::vector<std::uint32_t> count(static_cast<std::size_t>(labels.num_labels));
  for (const std::uint32_t i : labelled) ++count[static_cast<std::size_t>(labels.of_point[i])];
  const float min_points = std::max(3.0f, config.min_area_m2 / (leaf_size_m * leaf_size_m));

  Segments segments;
  std::pmr::vector<std::uint32_t*> next;  // place for the next point of each segment
  std::pmr::vector<std::int32_t> segment_of_label(count.size(), -1);
  for (std::size_t label = 0; label < count.size(); ++label) {
    if (static_cast<float>(count[label]) < min_points) continue;
    segment_of_label[label] = static_cast<std::int32_t>(segments.list.size());
    segments.list.emplace_back().points.resize(count[label]);
    next.push_back(segments.list.back().points.data());
  }
  segments.of_point.assign(cloud.size(), -1);
  std::int32_t* of_point = segments.of_point.data();
  for (const std::uint32_t i : labelled) {
    const std::int32_t s = segment_of_label[static_cast<std::size_t>(labels.of_point[i])];
    of_point[i] = s;
    if (s >= 0) *next[static_cast<std::size_t>(s)]++ = i;
  }
  tbb::parallel_for(std::size_t{0}, segments.list.size(),
                    [&](std::size_t s) { set_axes(cloud, segments.list[s]); });
  return segments;
}

}  // namespace graspd
