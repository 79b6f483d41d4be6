// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/leftovers.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>

#include "service/pipeline/union_find.hpp"

namespace graspd {
namespace {

/// The points that take part and are of no surface that is large enough, ascending.
std::pmr::vector<std::uint32_t> find_leftovers(std::span<const std::uint32_t> points,
                                               const std::pmr::vector<std::uint8_t>& excluded,
                                               float min_points, const Labels& labels) {
  std::pmr::vector<std::uint32_t> count(static_cast<std::size_t>(labels.num_labels));
  for (const std::uint32_t i : points)
    if (labels.of_point[i] >= 0) ++count[static_cast<std::size_t>(labels.of_point[i])];
  std::pmr::vector<std::uint32_t> left;
  for (const std::uint32_t i : points) {
    const std::int32_t label = labels.of_point[i];
    const bool is_of_surface =
        label >= 0 && static_cast<float>(count[static_cast<std::size_t>(label)]) >= min_points;
    if (!is_of_surface && (excluded.empty() || excluded[i] == 0)) left.push_back(i);
  }
  return left;
}

/// At least a few times as long as wide.
bool is_long(const PointCloud& cloud, const std::pmr::vector<std::uint32_t>& points) {
  constexpr double kLonger = 16;  // variance along the axis against that across it
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : points) mean += cloud.point(i).cast<double>();
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : points) {
    const Eigen::Vector3d d = cloud.point(i).cast<double>() - mean;
    covariance += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(2) >= kLonger * solver.eigenvalues()(1);
}

/// The components of the points that are left, in the order of their first points.
std::pmr::map<std::uint32_t, std::pmr::vector<std::uint32_t>> components(
    const Neighborhoods& neighborhoods, const std::pmr::vector<std::uint32_t>& left) {
  std::pmr::vector<std::uint8_t> is_left(neighborhoods.size());
  for (const std::uint32_t i : left) is_left[i] = 1;
  UnionFind sets(is_left.size());
  for (const std::uint32_t i : left)
    for (const std::uint32_t j : neighborhoods.of(i))
      if (j > i && is_left[j] != 0) sets.unite(i, j);
  std::pmr::map<std::uint32_t, std::pmr::vector<std::uint32_t>> result;
  for (const std::uint32_t i : left) result[sets.find(i)].push_back(i);
  return result;
}

/// Whether hardly any of the points have neighbours of a surface: they are no part of something else. points:
/// a component, ascending, so that what has a label beside it is of a surface.
bool stand_alone(const Neighborhoods& neighborhoods, const std::pmr::vector<std::uint32_t>& points,
                 const Labels& labels) {
  constexpr float kMostAtSurfaces = 0.2f;
  const auto touches = std::count_if(points.begin(), points.end(), [&](std::uint32_t i) {
    const std::span<const std::uint32_t> near = neighborhoods.of(i);
    return std::any_of(near.begin(), near.end(), [&](std::uint32_t j) {
      return labels.of_point[j] >= 0 && !std::binary_search(points.begin(), points.end(), j);
    });
  });
  return static_cast<float>(touches) <= kMostAtSurfaces * static_cast<float>(points.size());
}

}  // namespace

void label_leftovers(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                     const std::pmr::vector<std::uint8_t>& excluded, float min_points, Labels& labels) {
  for (const auto& [first, points] :
       components(neighborhoods, find_leftovers(neighborhoods.points(), excluded, min_points, labels))) {
    if (static_cast<float>(points.size()) < min_points) continue;
    if (!is_long(cloud, points) && !stand_alone(neighborhoods, points, labels)) continue;
    for (const std::uint32_t i : points) labels.of_point[i] = labels.num_labels;
    ++labels.num_labels;
  }
}

}  // namespace graspd
