// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/support.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "service/pipeline/coarse_surface.hpp"
#include "service/pipeline/level_search.hpp"
#include "service/pipeline/plane_search.hpp"
#include "service/pipeline/union_find.hpp"

namespace graspd {
namespace {

constexpr float kClearlyNoObject = 4;        // times the smallest area: larger than faces of objects are
constexpr std::size_t kScatterSize = 10000;  // points that the scatter is measured on

std::pmr::vector<std::uint8_t> points_above(const RawVector<float>& heights, float lowest_m) {
  std::pmr::vector<std::uint8_t> is_above(heights.size());
  for (std::size_t i = 0; i < heights.size(); ++i) is_above[i] = heights[i] > lowest_m ? 1 : 0;
  return is_above;
}

std::pmr::vector<std::uint8_t> points_within(const RawVector<float>& heights, float distance_m) {
  std::pmr::vector<std::uint8_t> is_within(heights.size());
  for (std::size_t i = 0; i < heights.size(); ++i) is_within[i] = std::abs(heights[i]) < distance_m ? 1 : 0;
  return is_within;
}

/// A point whose normal is there, and how much of its surroundings it stands for.
struct Witness {
  std::uint32_t point;
  double weight;
};

/// Those of the sample, and near an upper plane all.
std::pmr::vector<Witness> witnesses(const CoarseSurface& coarse) {
  std::pmr::vector<Witness> all;
  for (std::uint32_t i = 0; i < coarse.size(); ++i) {
    if (!coarse.has_normal(i)) continue;
    const float distance = (coarse.cloud().point(i) - coarse.cloud().viewpoint).norm();
    all.push_back({i, 1 / static_cast<double>(sample_weight(distance))});
  }
  return all;
}

/// Least squares over the inliers among the witnesses. Returns about how many inliers there are among all
/// points.
float refine(const CoarseSurface& coarse, const std::pmr::vector<Witness>& witnesses,
             const PlaneLimits& limits, Plane& plane) {
  const RawVector<float> heights = heights_above(plane, coarse.cloud());
  int num_near = 0;
  for (const float height : heights) num_near += int{std::abs(height) < limits.thickness_m};
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double num_asked = 0, n = 0;
  for (const auto& [i, weight] : witnesses) {
    if (!(std::abs(heights[i]) < limits.thickness_m)) continue;
    num_asked += weight;
    if (plane.normal.dot(coarse.normals().at(i)) <= limits.min_cosine) continue;
    const Eigen::Vector3d q = coarse.cloud().point(i).cast<double>();
    sum += weight * q;
    squares += weight * q * q.transpose();
    n += weight;
  }
  if (n < 3) return 0;
  const Eigen::Vector3d mean = sum / n;
  const Eigen::Matrix3d covariance = squares / n - mean * mean.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  Eigen::Vector3f normal = solver.eigenvectors().col(0).cast<float>();
  if (normal.dot(plane.normal) < 0) normal = -normal;
  plane = {normal, -normal.dot(mean.cast<float>())};
  return static_cast<float>(static_cast<double>(num_near) * n / num_asked);
}

/// Largest number of points of a plane that hang together.
std::size_t connected_points(const CoarseSurface& coarse, const Plane& plane, const PlaneLimits& limits) {
  std::pmr::vector<std::uint8_t> belongs =
      points_within(heights_above(plane, coarse.cloud()), 1.5f * limits.thickness_m);
  for (std::size_t i = 0; i < belongs.size(); ++i)
    if (belongs[i] != 0 && plane.normal.dot(coarse.normals().at(i)) <= limits.min_cosine) belongs[i] = 0;
  const Neighborhoods neighborhoods = coarse.neighborhoods(belongs);
  UnionFind sets(coarse.size());
  std::pmr::vector<std::size_t> count(coarse.size());
  for (std::uint32_t i = 0; i < coarse.size(); ++i) {
    if (belongs[i] == 0) continue;
    for (const std::uint32_t j : neighborhoods.of(i))
      if (j > i && belongs[j] != 0) sets.unite(i, j);
  }
  std::size_t most = 0;
  for (std::uint32_t i = 0; i < coarse.size(); ++i)
    if (belongs[i] != 0) most = std::max(most, ++count[sets.find(i)]);
  return most;
}

/// The highest plane parallel to the one given, and well above it, that has the points; else the one given.
Plane highest_parallel(CoarseSurface& coarse, const Plane& plane, const PlaneLimits& limits,
                       std::size_t min_points) {
  constexpr float kWellAbove = 0.1f;
  const RawVector<float> heights = heights_above(plane, coarse.cloud());
  // Those of the lowest level, too.
  coarse.prepare(points_above(heights, kWellAbove - 3 * limits.thickness_m));
  std::pmr::vector<std::size_t> levels;  // points with the plane's normal, by height above it
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    if (heights[i] < kWellAbove || plane.normal.dot(coarse.normals().at(i)) <= limits.min_cosine) continue;
    const auto level = static_cast<std::size_t>(heights[i] / limits.thickness_m);
    if (level >= levels.size()) levels.resize(level + 1);
    ++levels[level];
  }
  for (std::size_t level = levels.size(); level-- > 0;) {
    // A surface between two levels has half of its points in each.
    const std::size_t here = levels[level] + (level > 0 ? levels[level - 1] : 0);
    if (levels[level] == 0 || here < min_points) continue;
    Plane upper{plane.normal, plane.offset_m - limits.thickness_m * static_cast<float>(level)};
    if (connected_points(coarse, upper, limits) >= min_points) return upper;
  }
  return plane;
}

/// Root mean square distance from the plane of the points near it.
float scatter(const PointCloud& cloud, const Plane& plane, float thickness_m) {
  const std::size_t step = std::max<std::size_t>(1, cloud.size() / kScatterSize);
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < cloud.size(); i += step) {
    const float height = plane.height(cloud.point(i));
    if (std::abs(height) >= thickness_m) continue;
    sum += static_cast<double>(height) * static_cast<double>(height);
    ++n;
  }
  return n > 0 ? static_cast<float>(std::sqrt(sum / n)) : 0.0f;
}

}  // namespace

float support_thickness(const Eigen::Vector3f& p, const Eigen::Vector3f& viewpoint, float sigma_m,
                        const SupportConfig& config) {
  const float beyond = std::max(0.0f, (p - viewpoint).norm() - 0.8f);
  return std::max(config.min_thickness_m, 3.5f * sigma_m) + config.thickness_per_m * beyond;
}

namespace {

/// What tells points of the support: those lower than least_m, or than their own thickness.
struct Heights {
  const PointCloud& cloud;
  const Plane& plane;
  float least_m, per_m;
};

/// 1 for each of points [begin, end) that is lower than least_m, and for each that may be lower than its
/// thickness: no distance is more than the sum of its coordinates.
void compare_heights(const Heights& h, std::size_t begin, std::size_t end, std::uint8_t* is_lower,
                     std::uint8_t* may_be_lower) {
  const float nx = h.plane.normal.x(), ny = h.plane.normal.y(), nz = h.plane.normal.z(),
              offset = h.plane.offset_m;
  const float vx = h.cloud.viewpoint.x(), vy = h.cloud.viewpoint.y(), vz = h.cloud.viewpoint.z();
  const float least = h.least_m, per_m = h.per_m;
  const float *x = h.cloud.x.data() + begin, *y = h.cloud.y.data() + begin, *z = h.cloud.z.data() + begin;
  constexpr std::size_t kBlock = 64;
  int lower[kBlock], may[kBlock];
  for (std::size_t from = 0; from < end - begin; from += kBlock) {
    const std::size_t size = std::min(kBlock, end - begin - from);
    // Summed as Plane::height() does it.
    for (std::size_t k = 0; k < size; ++k) {
      const float px = x[from + k], py = y[from + k], pz = z[from + k];
      const float height = nx * px + (ny * py + nz * pz) + offset;
      const float most = std::abs(px - vx) + std::abs(py - vy) + std::abs(pz - vz);
      lower[k] = int{height < least};
      may[k] = int{height < least + per_m * most};
    }
    for (std::size_t k = 0; k < size; ++k) {
      is_lower[begin + from + k] = static_cast<std::uint8_t>(lower[k]);
      may_be_lower[begin + from + k] = static_cast<std::uint8_t>(may[k]);
    }
  }
}

/// The first of the places [i, end) at which the marks differ, or the end.
std::size_t first_difference(const std::uint8_t* a, const std::uint8_t* b, std::size_t i, std::size_t end) {
  std::uint64_t of_a = 0, of_b = 0;
  for (; i + sizeof(of_a) <= end; i += sizeof(of_a)) {
    std::memcpy(&of_a, a + i, sizeof(of_a));
    std::memcpy(&of_b, b + i, sizeof(of_b));
    if (of_a != of_b) break;
  }
  while (i != end && a[i] == b[i]) ++i;
  return i;
}

std::pmr::vector<std::uint8_t> points_of(const Support& support, const PointCloud& cloud,
                                         const SupportConfig& config) {
  const Heights heights{cloud, support.plane,
                        support_thickness(cloud.viewpoint, cloud.viewpoint, support.sigma_m, config),
                        config.thickness_per_m};
  RawVector<std::uint8_t> may_belong(cloud.size());
  std::pmr::vector<std::uint8_t> is_support(cloud.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cloud.size(), 8192), [&](const auto& range) {
    compare_heights(heights, range.begin(), range.end(), is_support.data(), may_belong.data());
    for (std::size_t i = first_difference(is_support.data(), may_belong.data(), range.begin(), range.end());
         i != range.end(); i = first_difference(is_support.data(), may_belong.data(), i + 1, range.end())) {
      const Eigen::Vector3f p = cloud.point(i);
      const float thickness = support_thickness(p, cloud.viewpoint, support.sigma_m, config);
      is_support[i] = support.plane.height(p) < thickness ? 1 : 0;
    }
  });
  return is_support;
}

/// Least squares for those besides the support.
void settle_levels(const CoarseSurface& coarse, const PlaneLimits& limits, Support& support) {
  if (support.levels.empty()) return;
  const std::pmr::vector<Witness> asked = witnesses(coarse);
  for (Level& level : support.levels) {
    if (level.plane.offset_m == support.plane.offset_m) continue;
    for (int round = 0; round < 2; ++round) refine(coarse, asked, limits, level.plane);
  }
}

/// The same where there are several levels. Of what is below an upper one only its front belongs to it.
std::pmr::vector<std::uint8_t> points_of_levels(const Support& support, const PointCloud& cloud,
                                                const SupportConfig& config) {
  constexpr float kMostFront = 0.04f;  // height of a board's front [m]
  std::pmr::vector<std::uint8_t> is_support(cloud.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cloud.size(), 8192), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Eigen::Vector3f p = cloud.point(i);
      const float thickness = support_thickness(p, cloud.viewpoint, support.sigma_m, config);
      bool is_lowest = true;
      for (const Level& level : support.levels) {
        const float height = level.plane.height(p);
        if (height < thickness && (is_lowest || (height > -kMostFront && level.extent.covers(p, 1))))
          is_support[i] = 1;
        is_lowest = false;
      }
    }
  });
  return is_support;
}

}  // namespace

std::optional<Support> find_support(const PointCloud& cloud, const SupportConfig& config) {
  if (!config.enabled || cloud.empty()) return std::nullopt;
  CoarseSurface coarse(cloud, config.leaf_size_m);
  const PlaneLimits limits{config.thickness_m,
                           std::cos(config.max_normal_angle_deg * std::numbers::pi_v<float> / 180)};
  const auto hypothesis = find_plane(coarse, config.hypotheses, limits, cloud.viewpoint);
  if (!hypothesis) return std::nullopt;
  Support support;
  const auto upper_points =
      static_cast<std::size_t>(config.min_upper_area_m2 / (config.leaf_size_m * config.leaf_size_m));
  support.plane = highest_parallel(coarse, *hypothesis, limits, upper_points);
  float inliers = 0;
  const std::pmr::vector<Witness> asked = witnesses(coarse);
  for (int round = 0; round < 3; ++round) inliers = refine(coarse, asked, limits, support.plane);
  const float area_m2 = inliers * config.leaf_size_m * config.leaf_size_m;
  if (area_m2 < config.min_area_m2) return std::nullopt;
  // Where the support was cut away, the largest face of an object must not take its place.
  if (area_m2 < kClearlyNoObject * config.min_area_m2 &&
      !has_things_on(coarse, support.plane, limits, config))
    return std::nullopt;
  support.sigma_m = scatter(cloud, support.plane, config.thickness_m);
  support.levels = find_levels(coarse, support.plane, limits, config);
  settle_levels(coarse, limits, support);
  support.is_support =
      support.levels.empty() ? points_of(support, cloud, config) : points_of_levels(support, cloud, config);
  return support;
}

}  // namespace graspd
