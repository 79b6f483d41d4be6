// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/level_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "service/pipeline/nth_value.hpp"

namespace graspd {
namespace {

constexpr float kApart = 0.03f;         // levels, at least [m]
constexpr float kMostScatter = 0.005f;  // of a level: things on it are told from it [m]

/// Heights of a coarse surface's points above the support.
class LevelSearch {
 public:
  LevelSearch(CoarseSurface& coarse, const Plane& support, const PlaneLimits& limits,
              const SupportConfig& config)
      : coarse_(coarse),
        support_(support),
        limits_(limits),
        config_(config),
        heights_(heights_above(support, coarse.cloud())) {}

  std::pmr::vector<Level> run();
  [[nodiscard]] bool support_has_things() const { return has_things_on_it(level_at(0, points_at(0)), 0); }

 private:
  [[nodiscard]] std::pmr::vector<float> heights_with_many_points() const;
  [[nodiscard]] std::pmr::vector<std::uint32_t> points_at(float height_m) const;
  [[nodiscard]] Level level_at(float height_m, std::span<const std::uint32_t> points) const {
    const Plane plane{support_.normal, support_.offset_m - height_m};
    return {plane, LevelExtent(coarse_.cloud(), points, plane, coarse_.leaf_size_m())};
  }
  [[nodiscard]] bool is_solid(const Level& level, float height_m) const;
  [[nodiscard]] bool is_large(const Level& level) const {
    return level.extent.area_m2() >= config_.min_level_area_m2 &&
           level.extent.width_m() >= config_.min_level_width_m;
  }
  [[nodiscard]] bool has_things_on_it(const Level& level, float height_m) const;
  [[nodiscard]] float scatter(const Level& level, float height_m) const;
  [[nodiscard]] float mean_height(float about_m) const;
  [[nodiscard]] bool is_flat(const Level& level, std::span<const std::uint32_t> points);

  CoarseSurface& coarse_;
  const Plane& support_;
  const PlaneLimits& limits_;
  const SupportConfig& config_;
  RawVector<float> heights_;
};

/// In the middle of those layers, as thick as a plane may be, that have the points of a level; the fullest
/// first.
std::pmr::vector<float> LevelSearch::heights_with_many_points() const {
  constexpr std::size_t kMostLayers = 4096;
  if (heights_.empty()) return {};
  const float thickness = limits_.thickness_m;
  const float lowest = *std::min_element(heights_.begin(), heights_.end());
  std::pmr::vector<std::size_t> layers;
  for (const float height : heights_) {
    const auto layer = static_cast<std::size_t>((height - lowest) / thickness);
    if (std::abs(height) < kApart || layer >= kMostLayers) continue;
    if (layer >= layers.size()) layers.resize(layer + 2);
    ++layers[layer];
  }
  const auto enough =
      static_cast<std::size_t>(config_.min_level_area_m2 / (coarse_.leaf_size_m() * coarse_.leaf_size_m()));
  std::pmr::vector<std::pair<std::size_t, std::size_t>> full;  // number of points, layer
  for (std::size_t k = 0; k + 1 < layers.size(); ++k)
    if (layers[k] + layers[k + 1] >= enough) full.emplace_back(layers[k] + layers[k + 1], k);
  std::sort(full.rbegin(), full.rend());
  std::pmr::vector<float> heights;
  for (const auto& [num, k] : full) heights.push_back(lowest + thickness * static_cast<float>(k + 1));
  return heights;
}

std::pmr::vector<std::uint32_t> LevelSearch::points_at(float height_m) const {
  std::pmr::vector<std::uint32_t> points;
  for (std::uint32_t i = 0; i < heights_.size(); ++i)
    if (std::abs(heights_[i] - height_m) < 1.5f * limits_.thickness_m) points.push_back(i);
  return points;
}

bool LevelSearch::has_things_on_it(const Level& level, float height_m) const {
  constexpr float kLowest = 0.02f, kHighest = 0.3f;  // of what counts, above the level [m]
  constexpr std::size_t kNeighbors = 4;  // at least, of a point of a surface: not of one that noise made
  constexpr int kFewest = 15;
  std::pmr::vector<std::uint8_t> is_above(heights_.size());
  for (std::size_t i = 0; i < heights_.size(); ++i) {
    const float above = heights_[i] - height_m;
    if (above > kLowest && above < kHighest && level.extent.covers(coarse_.cloud().point(i), 1))
      is_above[i] = 1;
  }
  const Neighborhoods neighborhoods = coarse_.neighborhoods(is_above);
  int num = 0;
  for (std::uint32_t i = 0; i < heights_.size(); ++i) {
    if (is_above[i] == 0) continue;
    const auto& around = neighborhoods.of(i);
    const auto is_thing = [&](std::uint32_t j) { return j != i && is_above[j] != 0; };
    if (static_cast<std::size_t>(std::count_if(around.begin(), around.end(), is_thing)) >= kNeighbors) ++num;
  }
  return num >= kFewest;
}

/// Standard deviation of the level's points about it; far above it there are things. Far away a surface may
/// scatter so much that its own points seem to be things on it.
float LevelSearch::scatter(const Level& level, float height_m) const {
  constexpr float kDeepest = 0.04f;  // of what counts, below the level [m]
  constexpr float kOfMedian = 1.48f;
  const float highest = 1.5f * limits_.thickness_m;
  std::pmr::vector<float> distances;
  for (std::size_t i = 0; i < heights_.size(); ++i) {
    const float above = heights_[i] - height_m;
    if (above > -kDeepest && above < highest && level.extent.covers(coarse_.cloud().point(i), 0))
      distances.push_back(std::abs(above));
  }
  return distances.empty() ? 0 : kOfMedian * nth_value(distances, distances.size() / 2);
}

/// Of the points about there.
float LevelSearch::mean_height(float about_m) const {
  float sum = 0, n = 0;
  for (const std::uint32_t i : points_at(about_m)) {
    sum += heights_[i];
    ++n;
  }
  return n > 0 ? sum / n : about_m;
}

/// Whether nothing is seen well below it. Its borders do not count: a block's sides are there.
bool LevelSearch::is_solid(const Level& level, float height_m) const {
  constexpr float kWellBelow = 0.05f, kInside = 0.03f;  // [m]
  constexpr int kFewest = 15;
  const Eigen::Vector3f u = kInside * level.plane.normal.unitOrthogonal(), v = level.plane.normal.cross(u);
  const auto is_inside = [&](const Eigen::Vector3f& p) {
    return level.extent.covers(p + u, 0) && level.extent.covers(p - u, 0) && level.extent.covers(p + v, 0) &&
           level.extent.covers(p - v, 0);
  };
  int num = 0;
  for (std::size_t i = 0; i < heights_.size(); ++i)
    if (heights_[i] < height_m - kWellBelow && is_inside(coarse_.cloud().point(i))) ++num;
  return num < kFewest;
}

bool LevelSearch::is_flat(const Level& level, std::span<const std::uint32_t> points) {
  constexpr float kMinShare = 0.6f;  // with the plane's normal
  std::pmr::vector<std::uint8_t> wanted(coarse_.size());
  for (const std::uint32_t i : points) wanted[i] = level.extent.covers(coarse_.cloud().point(i), 0) ? 1 : 0;
  coarse_.prepare(wanted);
  float num = 0, num_level = 0;
  for (const std::uint32_t i : points) {
    if (wanted[i] == 0) continue;
    ++num;
    if (support_.normal.dot(coarse_.normals().at(i)) > limits_.min_cosine) ++num_level;
  }
  return num_level >= kMinShare * num;
}

std::pmr::vector<Level> LevelSearch::run() {
  std::pmr::vector<std::pair<float, Level>> found;
  std::pmr::vector<float> tried;
  for (const float layer : heights_with_many_points()) {
    if (std::any_of(tried.begin(), tried.end(),
                    [&](float other) { return std::abs(other - layer) < kApart; }))
      continue;
    tried.push_back(layer);
    const float height = mean_height(mean_height(layer));
    const std::pmr::vector<std::uint32_t> points = points_at(height);
    Level level = level_at(height, points);
    if (is_large(level) && scatter(level, height) < kMostScatter && has_things_on_it(level, height) &&
        is_flat(level, points))
      found.emplace_back(height, std::move(level));
  }
  if (found.empty()) return {};
  found.emplace_back(0.0f, level_at(0, points_at(0)));
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::pmr::vector<Level> levels;
  for (auto& [height, level] : found) {
    level.is_solid = is_solid(level, height);
    levels.push_back(std::move(level));
  }
  return levels;
}

}  // namespace

std::pmr::vector<Level> find_levels(CoarseSurface& coarse, const Plane& support, const PlaneLimits& limits,
                                    const SupportConfig& config) {
  return LevelSearch(coarse, support, limits, config).run();
}

bool has_things_on(CoarseSurface& coarse, const Plane& plane, const PlaneLimits& limits,
                   const SupportConfig& config) {
  return LevelSearch(coarse, plane, limits, config).support_has_things();
}

}  // namespace graspd
