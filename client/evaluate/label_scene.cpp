// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/label_scene.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

namespace graspd {
namespace {

constexpr float kCell = 0.015f;  // of the grid for box queries [m]
constexpr std::size_t kMinPlanePoints = 100;
constexpr int kHypotheses = 100;
constexpr float kInlier = 0.008f;  // from the plane [m]

Plane oriented(const Eigen::Vector3f& normal, const Eigen::Vector3f& point,
               const Eigen::Vector3f& viewpoint) {
  Plane plane{normal, -normal.dot(point)};
  if (plane.height(viewpoint) < 0) plane = {-normal, normal.dot(point)};
  return plane;
}

/// Least squares over the points close to a first guess.
Plane refined(const Plane& guess, const std::vector<Eigen::Vector3f>& points,
              const Eigen::Vector3f& viewpoint) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double n = 0;
  for (const Eigen::Vector3f& p : points) {
    if (std::abs(guess.height(p)) > kInlier) continue;
    const Eigen::Vector3d q = p.cast<double>();
    sum += q;
    squares += q * q.transpose();
    n += 1;
  }
  if (n < 3) return guess;
  const Eigen::Vector3d mean = sum / n;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares / n - mean * mean.transpose());
  const Eigen::Vector3f normal = solver.eigenvectors().col(0).cast<float>();
  return oriented(normal, mean.cast<float>(), viewpoint);
}

/// Of the lowest support label that has enough points: higher ones are walls and other furniture.
std::optional<Plane> support_plane(const PointCloud& cloud, const std::vector<std::uint32_t>& label) {
  std::map<std::uint32_t, std::vector<Eigen::Vector3f>> by_label;
  for (std::size_t i = 0; i < label.size(); ++i)
    if (object_of_label(label[i]) == kOnSupport) by_label[label[i]].push_back(cloud.point(i));
  for (const auto& [value, points] : by_label)
    if (auto plane = fit_plane(points, cloud.viewpoint)) return plane;
  return std::nullopt;
}

}  // namespace

int object_of_label(std::uint32_t label) {
  if (label == 0) return kNoObject;
  return label < 10 ? kOnSupport : static_cast<int>(label / 10);
}

std::optional<Plane> fit_plane(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& viewpoint) {
  if (points.size() < kMinPlanePoints) return std::nullopt;
  // The same points give the same plane. The distribution is the library's own, this arithmetic is not.
  std::minstd_rand random(1);
  const std::size_t step = std::max<std::size_t>(points.size() / 2000, 1);
  const auto any = [&]() -> const Eigen::Vector3f& { return points[random() % points.size()]; };
  std::optional<Plane> best;
  int best_inliers = 0;
  for (int k = 0; k < kHypotheses; ++k) {
    const Eigen::Vector3f &a = any(), &b = any(), &c = any();
    const Eigen::Vector3f normal = (b - a).cross(c - a);
    if (normal.norm() < 1e-8f) continue;
    const Plane plane = oriented(normal.normalized(), a, viewpoint);
    int inliers = 0;
    for (std::size_t i = 0; i < points.size(); i += step)
      inliers += std::abs(plane.height(points[i])) < kInlier ? 1 : 0;
    if (inliers <= best_inliers) continue;
    best = plane;
    best_inliers = inliers;
  }
  if (best) best = refined(*best, points, viewpoint);
  return best;
}

PointCloud LabelScene::finite_points(const LabelledCloud& labelled, std::vector<std::uint32_t>& label) {
  const PointCloud& all = labelled.cloud;
  if (labelled.label.size() != all.size()) throw std::runtime_error("has no labels (field `label`)");
  PointCloud cloud;
  cloud.viewpoint = all.viewpoint;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all.point(i).allFinite()) continue;
    cloud.push_back(all.point(i));
    label.push_back(labelled.label[i]);
  }
  cloud.width = static_cast<int>(cloud.size());
  return cloud;
}

LabelScene::LabelScene(const LabelledCloud& labelled)
    : cloud_(finite_points(labelled, label_)),
      support_(support_plane(cloud_, label_)),
      query_(cloud_, kCell),
      depth_map_(cloud_) {
  std::map<int, int> points;
  object_.reserve(label_.size());
  for (const std::uint32_t label : label_) {
    object_.push_back(object_of_label(label));
    if (object_.back() >= 0) ++points[object_.back()];
  }
  for (const auto& [id, count] : points) objects_.push_back({id, count});
}

}  // namespace graspd
