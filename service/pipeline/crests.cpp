// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/crests.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace graspd {
namespace {

constexpr float kCell = 0.006f;           // seen from above [m]
constexpr float kReach = 0.018f;          // of the crest that is looked at around a place [m]
constexpr float kRise = 0.004f;           // what is higher than a crest by this much is not beside it [m]
constexpr float kFall = 0.008f;           // what is lower by this much is not the crest any more [m]
constexpr float kMinDeviation = 0.006f;   // along it [m]
constexpr float kMaxDeviation = 0.0045f;  // across it [m]
constexpr int kMinCells = 4;

/// The highest point of a cell, in coordinates with z up.
struct Top {
  Eigen::Vector3f place;
  std::uint32_t point;
};
using Tops = std::map<std::pair<int, int>, Top>;

Tops highest_points(const PointCloud& cloud, const std::vector<std::uint32_t>& points,
                    const Eigen::Matrix3f& to_upright) {
  Tops tops;
  for (const std::uint32_t i : points) {
    const Eigen::Vector3f p = to_upright * cloud.point(i);
    const std::pair cell{static_cast<int>(std::floor(p.x() / kCell)),
                         static_cast<int>(std::floor(p.y() / kCell))};
    const auto [it, is_new] = tops.try_emplace(cell, Top{p, i});
    if (!is_new && p.z() > it->second.place.z()) it->second = {p, i};
  }
  return tops;
}

/// Direction of the crest around a top, seen from above; nothing where there is none.
std::optional<Eigen::Vector2f> crest_direction(const Tops& tops, const std::pair<int, int>& cell,
                                               const Top& top) {
  const int reach = static_cast<int>(std::ceil(kReach / kCell));
  int n = 0;
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  Eigen::Matrix2f squares = Eigen::Matrix2f::Zero();
  for (int x = cell.first - reach; x <= cell.first + reach; ++x)
    for (auto it = tops.lower_bound({x, cell.second - reach});
         it != tops.end() && it->first <= std::pair{x, cell.second + reach}; ++it) {
      const Eigen::Vector3f d = it->second.place - top.place;
      if (d.head<2>().norm() > kReach) continue;
      if (d.z() > kRise) return std::nullopt;
      if (d.z() < -kFall) continue;
      ++n;
      sum += d.head<2>();
      squares += d.head<2>() * d.head<2>().transpose();
    }
  if (n < kMinCells) return std::nullopt;
  const Eigen::Vector2f mean = sum / static_cast<float>(n);
  const Eigen::Matrix2f cov = squares / static_cast<float>(n) - mean * mean.transpose();
  const float half_trace = 0.5f * cov.trace();
  const float root = std::sqrt(std::max(0.0f, half_trace * half_trace - cov.determinant()));
  if (half_trace + root < kMinDeviation * kMinDeviation || half_trace - root > kMaxDeviation * kMaxDeviation)
    return std::nullopt;
  const float angle = 0.5f * std::atan2(2 * cov(0, 1), cov(0, 0) - cov(1, 1));
  return Eigen::Vector2f(std::cos(angle), std::sin(angle));
}

}  // namespace

std::vector<Crest> find_crests(const PointCloud& cloud, const std::vector<std::uint32_t>& points,
                               const Eigen::Vector3f& up, float spacing_m) {
  Eigen::Matrix3f to_upright;
  to_upright.row(0) = up.unitOrthogonal();
  to_upright.row(1) = up.cross(to_upright.row(0).transpose());
  to_upright.row(2) = up;
  const Tops tops = highest_points(cloud, points, to_upright);
  std::vector<Crest> crests;
  for (const auto& [cell, top] : tops) {
    const Eigen::Vector3f place = cloud.point(top.point);
    const auto near = [&](const Crest& other) {
      return (cloud.point(other.point) - place).norm() < spacing_m;
    };
    if (std::any_of(crests.begin(), crests.end(), near)) continue;
    const std::optional<Eigen::Vector2f> direction = crest_direction(tops, cell, top);
    if (!direction) continue;
    crests.push_back({top.point, direction->x() * to_upright.row(0).transpose() +
                                     direction->y() * to_upright.row(1).transpose()});
  }
  return crests;
}

}  // namespace graspd
