// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/plane_search.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <numeric>
#include <random>

#include "service/pipeline/point_kernels.hpp"

namespace graspd {
namespace {

constexpr std::size_t kSampleSize = 2000;  // points that hypotheses are scored on

struct Sample {
  PointCloud points;
  Normals normals;
  float area_m2 = 0;  ///< of a surface that a point stands for, times the weight there

  /// Between the points on a surface at a distance [m].
  [[nodiscard]] float spacing_at(float distance_m) const {
    return std::sqrt(area_m2 / sample_weight(distance_m));
  }
};

/// Spread over surfaces by weight.
Sample take_sample(CoarseSurface& coarse, const Eigen::Vector3f& viewpoint) {
  const std::size_t n = coarse.size();
  RawVector<float> weights(n);
  float sum = 0, most = 0;
  for (std::size_t i = 0; i < n; ++i)
    weights[i] = sample_weight((coarse.cloud().point(i) - viewpoint).norm());
  for (const float weight : weights) {
    sum += weight;
    most = std::max(most, weight);
  }
  const float of_one = std::max(sum / kSampleSize, most);
  std::pmr::vector<std::uint8_t> is_in(n);
  float left = 0;
  for (std::size_t i = 0; i < n; ++i) {
    left += weights[i];
    if (left < of_one) continue;
    left -= of_one;
    is_in[i] = 1;
  }
  coarse.prepare(is_in);
  Sample sample;
  sample.area_m2 = coarse.leaf_size_m() * coarse.leaf_size_m() * of_one;
  for (std::size_t i = 0; i < n; ++i) {
    if (is_in[i] == 0) continue;
    sample.points.push_back(coarse.cloud().point(i));
    sample.normals.x.push_back(coarse.normals().x[i]);
    sample.normals.y.push_back(coarse.normals().y[i]);
    sample.normals.z.push_back(coarse.normals().z[i]);
  }
  return sample;
}

/// Where the points of a plane are, in square cells.
class Extent {
 public:
  Extent(const Sample& sample, const Plane& plane, const PlaneLimits& limits,
         const Eigen::Vector3f& viewpoint)
      : u_(plane.normal.unitOrthogonal()), v_(plane.normal.cross(u_)) {
    Eigen::Vector2f sum = Eigen::Vector2f::Zero();
    float distances = 0;
    std::pmr::vector<Eigen::Vector2f> places;
    for (std::size_t i = 0; i < sample.points.size(); ++i) {
      const Eigen::Vector3f p = sample.points.point(i);
      if (std::abs(plane.height(p)) >= limits.thickness_m ||
          plane.normal.dot(sample.normals.at(i)) <= limits.min_cosine)
        continue;
      places.emplace_back(u_.dot(p), v_.dot(p));
      sum += places.back();
      distances += (p - viewpoint).norm();
    }
    const auto n = static_cast<float>(std::max<std::size_t>(1, places.size()));
    center_ = sum / n;
    cell_m_ = kSpacings * sample.spacing_at(distances / n);
    for (const Eigen::Vector2f& place : places)
      if (const auto cell = cell_of(place)) is_taken_.set(*cell);
  }

  [[nodiscard]] bool has(const Eigen::Vector3f& p) const {
    const auto cell = cell_of({u_.dot(p), v_.dot(p)});
    return cell && is_taken_.test(*cell);
  }

 private:
  static constexpr std::size_t kSide = 128;
  static constexpr float kSpacings = 3;  // gaps as those between objects count as the plane's own

  [[nodiscard]] std::optional<std::size_t> cell_of(const Eigen::Vector2f& place) const {
    const Eigen::Vector2f at = (place - center_) / cell_m_ + Eigen::Vector2f::Constant(0.5f * kSide);
    if (!(at.minCoeff() >= 0 && at.maxCoeff() < kSide)) return std::nullopt;
    return static_cast<std::size_t>(at.y()) * kSide + static_cast<std::size_t>(at.x());
  }

  Eigen::Vector3f u_, v_;
  float cell_m_ = 0;
  Eigen::Vector2f center_;
  std::bitset<kSide * kSide> is_taken_;
};

/// Points that are seen through the plane: behind it, on lines of sight that pass it where its own points
/// are. A support hides what is behind it; beside it the floor may be seen. Counts no further than enough.
int seen_through(const Sample& sample, const Plane& plane, const PlaneLimits& limits,
                 const Eigen::Vector3f& viewpoint, int enough) {
  constexpr float kBehind = 3;  // times the thickness
  const Extent extent(sample, plane, limits, viewpoint);
  const float from = plane.height(viewpoint);
  int num = 0;
  for (std::size_t i = 0; i < sample.points.size() && num < enough; ++i) {
    const Eigen::Vector3f p = sample.points.point(i);
    const float height = plane.height(p);
    if (height < -kBehind * limits.thickness_m &&
        extent.has(viewpoint + from / (from - height) * (p - viewpoint)))
      ++num;
  }
  return num;
}

std::optional<Plane> plane_through(const Sample& sample, const std::array<std::size_t, 3>& at,
                                   float min_cosine, const Eigen::Vector3f& viewpoint) {
  const Eigen::Vector3f a = sample.points.point(at[0]);
  Eigen::Vector3f normal = (sample.points.point(at[1]) - a).cross(sample.points.point(at[2]) - a);
  if (normal.norm() < 1e-6f) return std::nullopt;
  normal.normalize();
  if (normal.dot(viewpoint - a) < 0) normal = -normal;
  for (const std::size_t i : at)
    if (normal.dot(sample.normals.at(i)) < min_cosine) return std::nullopt;
  return Plane{normal, -normal.dot(a)};
}

Eigen::Vector3f middle_of(const PointCloud& points) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) sum += points.point(i);
  return sum / static_cast<float>(points.size());
}

/// Whether least squares over the points of either would end in the same plane.
bool are_alike(const Plane& a, const Plane& b, const PlaneLimits& limits, const Eigen::Vector3f& middle) {
  constexpr float kSameCosine = 0.9995f;  // 1.8 degrees
  return a.normal.dot(b.normal) > kSameCosine &&
         std::abs(a.height(middle) - b.height(middle)) < limits.thickness_m;
}

/// Points of the sample that belong to the plane.
int count_on(const Sample& sample, const Plane& plane, const PlaneLimits& limits) {
  const PointCloud& points = sample.points;
  const Eigen::Vector3f& n = plane.normal;
  return point_kernels().count_on_plane(
      {{n.x(), n.y(), n.z()}, plane.offset_m, limits.thickness_m, limits.min_cosine},
      {points.x.data(), points.y.data(), points.z.data(), sample.normals.arrays(), points.size()});
}

/// Hypotheses, and how many points of the sample are on each.
struct Hypotheses {
  std::pmr::vector<Plane> planes;
  std::pmr::vector<int> num_on;
  std::pmr::vector<std::size_t> order;  // the most points first
};

Hypotheses make_hypotheses(const Sample& sample, int num, const PlaneLimits& limits,
                           const Eigen::Vector3f& viewpoint) {
  std::minstd_rand random(1);
  Hypotheses all;
  for (int trial = 0; trial < 20 * num && static_cast<int>(all.planes.size()) < num; ++trial) {
    std::array<std::size_t, 3> at{};
    for (std::size_t& i : at) i = random() % sample.points.size();
    if (const auto plane = plane_through(sample, at, limits.min_cosine, viewpoint))
      all.planes.push_back(*plane);
  }
  all.num_on.resize(all.planes.size());
  tbb::parallel_for(std::size_t{0}, all.planes.size(),
                    [&](std::size_t i) { all.num_on[i] = count_on(sample, all.planes[i], limits); });
  all.order.resize(all.planes.size());
  std::iota(all.order.begin(), all.order.end(), std::size_t{0});
  std::sort(all.order.begin(), all.order.end(), [&](std::size_t a, std::size_t b) {
    return all.num_on[a] != all.num_on[b] ? all.num_on[a] > all.num_on[b] : a < b;
  });
  return all;
}

struct Scored {
  Plane plane;
  int score;
};

/// The best one of those that may be, where its score is more than the least.
template <class MayBe>
std::optional<Scored> best_of(const Hypotheses& all, const Sample& sample, const PlaneLimits& limits,
                              const Eigen::Vector3f& viewpoint, int least_score, const MayBe& may_be) {
  std::optional<Scored> best;
  int best_score = least_score;
  std::pmr::vector<Plane> tried;
  const Eigen::Vector3f middle = middle_of(sample.points);
  for (const std::size_t i : all.order) {
    const Plane& plane = all.planes[i];
    if (all.num_on[i] <= best_score) break;
    if (!may_be(plane) || std::any_of(tried.begin(), tried.end(), [&](const Plane& other) {
          return are_alike(other, plane, limits, middle);
        }))
      continue;
    tried.push_back(plane);
    const int score =
        all.num_on[i] - seen_through(sample, plane, limits, viewpoint, all.num_on[i] - best_score);
    if (score <= best_score) continue;
    best_score = score;
    best = {plane, score};
  }
  return best;
}

}  // namespace

RawVector<float> heights_above(const Plane& plane, const PointCloud& cloud) {
  const float nx = plane.normal.x(), ny = plane.normal.y(), nz = plane.normal.z(), offset = plane.offset_m;
  const float *x = cloud.x.data(), *y = cloud.y.data(), *z = cloud.z.data();
  RawVector<float> heights(cloud.size());
  float* height = heights.data();
  // Summed as Plane::height() does it.
  for (std::size_t i = 0; i < heights.size(); ++i) height[i] = nx * x[i] + (ny * y[i] + nz * z[i]) + offset;
  return heights;
}

std::optional<Plane> find_plane(CoarseSurface& coarse, int num_hypotheses, const PlaneLimits& limits,
                                const Eigen::Vector3f& viewpoint) {
  constexpr float kFacesDown = 0.15f, kEnough = 0.4f;
  if (coarse.size() < 3) return std::nullopt;
  const Sample sample = take_sample(coarse, viewpoint);
  const Hypotheses all = make_hypotheses(sample, num_hypotheses, limits, viewpoint);
  const auto best = best_of(all, sample, limits, viewpoint, 0, [](const Plane&) { return true; });
  if (!best) return std::nullopt;
  const auto faces_down = [](const Plane& plane) { return plane.normal.y() > kFacesDown; };
  if (!viewpoint.isZero() || !faces_down(best->plane)) return best->plane;
  const auto enough = static_cast<int>(kEnough * static_cast<float>(best->score));
  const auto upright =
      best_of(all, sample, limits, viewpoint, enough, [&](const Plane& plane) { return !faces_down(plane); });
  return upright ? upright->plane : best->plane;
}

}  // namespace graspd
