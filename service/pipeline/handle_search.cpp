// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/handle_search.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "service/pipeline/cell_order.hpp"

namespace graspd {
namespace {

constexpr std::size_t kMostSeedsInAllDirections = 16;

using Directions = std::vector<Eigen::Vector3f>;

/// Adds a unit vector unless one that differs by less than the angle is there; signless: opposite ones are
/// the same.
void add_distinct(Directions& directions, const Eigen::Vector3f& v, float max_cosine, bool signless) {
  if (!(v.norm() > 1e-3f)) return;
  const Eigen::Vector3f unit = v.normalized();
  for (const Eigen::Vector3f& other : directions) {
    const float cosine = unit.dot(other);
    if ((signless ? std::abs(cosine) : cosine) > max_cosine) return;
  }
  directions.push_back(unit);
}

Eigen::Matrix3f gripper_axes(const Eigen::Vector3f& outward, const Eigen::Vector3f& major) {
  Eigen::Matrix3f axes;
  axes.col(2) = -outward;
  axes.col(0) = (major - major.dot(outward) * outward).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

/// In-plane axis of the rectangle of least area around a segment: where the outline is cut off by something
/// nearer, it follows the sides that are left better than the principal axes do.
Eigen::Vector3f rectangle_axis(const PointCloud& cloud, const Segment& segment) {
  constexpr int kAngles = 45;
  constexpr std::size_t kMaxPoints = 600;
  std::vector<Eigen::Vector2f> flat;
  const std::size_t step = std::max<std::size_t>(1, segment.points.size() / kMaxPoints);
  for (std::size_t k = 0; k < segment.points.size(); k += step) {
    const Eigen::Vector3f d = cloud.point(segment.points[k]) - segment.centroid;
    flat.emplace_back(d.dot(segment.major), d.dot(segment.minor));
  }
  float best_area = std::numeric_limits<float>::infinity();
  Eigen::Vector3f best = segment.major;
  for (int i = 0; i < kAngles; ++i) {
    const float angle = std::numbers::pi_v<float> / 2 * static_cast<float>(i) / kAngles;
    const Eigen::Vector2f u(std::cos(angle), std::sin(angle)), v(-u.y(), u.x());
    Eigen::Vector2f lo(1e9f, 1e9f), hi(-1e9f, -1e9f);
    for (const Eigen::Vector2f& p : flat) {
      const Eigen::Vector2f q(p.dot(u), p.dot(v));
      lo = lo.cwiseMin(q);
      hi = hi.cwiseMax(q);
    }
    const float area = (hi - lo).prod();
    if (area >= best_area) continue;
    best_area = area;
    best = u.x() * segment.major + u.y() * segment.minor;
  }
  return best;
}

/// One candidate a band of width e along an axis of the segment, from the centroid both ways (paper, section
/// 5).
void add_bands(const PointCloud& cloud, const Segment& segment, std::int32_t s, std::int32_t object,
               const Eigen::Vector3f& axis, float thickness_m, std::vector<Candidate>& out) {
  struct Band {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    int n = 0;
  };
  float reach = 0;
  for (const std::uint32_t i : segment.points)
    reach = std::max(reach, std::abs(axis.dot(cloud.point(i) - segment.centroid)));
  const int half = static_cast<int>(reach / thickness_m + 0.5f);
  std::vector<Band> bands(static_cast<std::size_t>(2 * half + 1));
  for (const std::uint32_t i : segment.points) {
    const float along = axis.dot(cloud.point(i) - segment.centroid) / thickness_m;
    Band& band = bands[static_cast<std::size_t>(
        std::clamp(static_cast<int>(std::floor(along + 0.5f)) + half, 0, 2 * half))];
    band.sum += cloud.point(i);
    ++band.n;
  }
  constexpr int kMinBandPoints = 8;
  for (const Band& band : bands)
    if (band.n >= kMinBandPoints)
      out.push_back({band.sum / static_cast<float>(band.n), gripper_axes(segment.normal, axis), s, object});
}

/// Mean normal of the object's voxels near a seed.
Eigen::Vector3f face_normal(const SearchInput& in, const std::vector<std::uint32_t>& points,
                            std::uint32_t seed) {
  constexpr float kRadius = 0.015f;
  const Eigen::Vector3f p = in.cloud.point(seed), n = in.normals.at(seed);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const std::uint32_t i : points) {
    if ((in.cloud.point(i) - p).squaredNorm() > kRadius * kRadius) continue;
    if (in.normals.at(i).dot(n) > 0.8f) sum += in.normals.at(i);
  }
  return sum.norm() > 1e-3f ? sum.normalized() : n;
}

/// For each occupied cell of the spacing the point nearest to the mean of those in it.
std::vector<std::uint32_t> spread_seeds(const PointCloud& cloud, const std::vector<std::uint32_t>& points,
                                        float spacing_m) {
  PointCloud own;
  for (const std::uint32_t i : points) own.push_back(cloud.point(i));
  const CellOrder order = order_by_cell(own, spacing_m);
  std::vector<std::uint32_t> seeds;
  for (std::size_t c = 0; c < order.num_cells(); ++c) {
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    for (const std::uint32_t k : order.cell(c)) mean += own.point(k);
    mean /= static_cast<float>(order.cell(c).size());
    const auto nearer = [&](std::uint32_t a, std::uint32_t b) {
      return (own.point(a) - mean).squaredNorm() < (own.point(b) - mean).squaredNorm();
    };
    seeds.push_back(points[*std::min_element(order.cell(c).begin(), order.cell(c).end(), nearer)]);
  }
  return seeds;
}

class SeedSearch {
 public:
  SeedSearch(const SearchInput& in, const HandleSearchConfig& config) : in_(in), config_(config) {
    max_cosine_ = std::cos(config.distinct_angle_deg * std::numbers::pi_v<float> / 180);
    rectangle_axes_.resize(in.segments.list.size());
    tbb::parallel_for(std::size_t{0}, rectangle_axes_.size(), [&](std::size_t s) {
      rectangle_axes_[s] = rectangle_axis(in.cloud, in.segments.list[s]);
    });
  }

  void add(const std::vector<std::uint32_t>& points, std::int32_t object, SearchRound round,
           std::vector<Candidate>& out) const {
    const std::vector<std::uint32_t> seeds = spread_seeds(in_.cloud, points, config_.seed_spacing_m);
    const std::size_t most = round == SearchRound::kAllDirections ? kMostSeedsInAllDirections : seeds.size();
    for (std::size_t k = 0; k < std::min(most, seeds.size()); ++k) {
      const std::uint32_t seed = seeds[k * seeds.size() / std::min(most, seeds.size())];
      const std::int32_t s = in_.segments.of_point[seed];
      if (s < 0) continue;
      Directions outward = approaches(points, seed);
      if (round == SearchRound::kAllDirections) outward.resize(std::min<std::size_t>(outward.size(), 2));
      for (std::size_t o = 0; o < outward.size(); ++o) {
        const Directions axes = closing_axes(static_cast<std::size_t>(s), outward[o], round);
        // The surface's own normal and axes first (paper, section 5), the support's normal next to them.
        for (std::size_t a = 0; a < axes.size(); ++a) {
          const bool first = o < 2 && a < 2;
          if (round == SearchRound::kAllDirections || first == (round == SearchRound::kSurface))
            out.push_back({in_.cloud.point(seed), gripper_axes(outward[o], axes[a]), s, object});
        }
      }
    }
  }

 private:
  [[nodiscard]] Directions approaches(const std::vector<std::uint32_t>& points, std::uint32_t seed) const {
    const Eigen::Vector3f to_sensor = (in_.cloud.viewpoint - in_.cloud.point(seed)).normalized();
    const Eigen::Vector3f n = face_normal(in_, points, seed);
    Directions outward;
    add_distinct(outward, n, max_cosine_, false);
    if (in_.support) {
      add_distinct(outward, in_.support->plane.normal, max_cosine_, false);
      add_distinct(outward, n + in_.support->plane.normal, max_cosine_, false);
    }
    add_distinct(outward, to_sensor, max_cosine_, false);
    std::erase_if(outward,
                  [&](const Eigen::Vector3f& o) { return o.dot(to_sensor) < config_.min_facing_cosine; });
    return outward;
  }

  [[nodiscard]] Directions closing_axes(std::size_t s, const Eigen::Vector3f& outward,
                                        SearchRound round) const {
    const Segment& segment = in_.segments.list[s];
    Directions suggested{rectangle_axes_[s], segment.normal.cross(rectangle_axes_[s]), segment.major,
                         segment.minor};
    if (in_.support) {
      suggested.push_back(in_.support->plane.normal);
      suggested.push_back(in_.support->plane.normal.cross(outward));
    }
    Directions axes;
    for (const Eigen::Vector3f& axis : suggested) {
      const Eigen::Vector3f across = axis - axis.dot(outward) * outward;
      if (across.norm() < 0.3f) continue;
      add_distinct(axes, across, max_cosine_, true);
      add_distinct(axes, across.cross(outward), max_cosine_, true);
    }
    return round == SearchRound::kAllDirections ? other_directions(outward, axes) : axes;
  }

  /// Evenly spread closing axes, less those that were tried.
  [[nodiscard]] Directions other_directions(const Eigen::Vector3f& outward, const Directions& tried) const {
    const Eigen::Vector3f u = outward.unitOrthogonal(), v = outward.cross(u);
    Directions axes;
    for (int i = 0; i < config_.all_directions; ++i) {
      const float angle =
          std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(config_.all_directions);
      const Eigen::Vector3f axis = std::cos(angle) * u + std::sin(angle) * v;
      const auto same = [&](const Eigen::Vector3f& t) { return std::abs(t.dot(axis)) > max_cosine_; };
      if (std::none_of(tried.begin(), tried.end(), same)) axes.push_back(axis);
    }
    return axes;
  }

  const SearchInput& in_;
  const HandleSearchConfig& config_;
  float max_cosine_ = 1;
  Directions rectangle_axes_;
};

}  // namespace

std::vector<Candidate> search_handles(const SearchInput& input, const Gripper& gripper,
                                      const HandleSearchConfig& config, SearchRound round,
                                      const std::vector<std::uint8_t>& wanted) {
  std::vector<Candidate> candidates;
  if (config.bands && round == SearchRound::kSurface)
    for (std::size_t s = 0; s < input.segments.list.size(); ++s) {
      const Segment& segment = input.segments.list[s];
      for (const Eigen::Vector3f& axis : {segment.major, segment.minor})
        add_bands(input.cloud, segment, static_cast<std::int32_t>(s), input.objects.of_segment[s], axis,
                  gripper.finger_thickness_m, candidates);
    }
  if (!config.seeds) return candidates;
  std::vector<std::vector<std::uint32_t>> points(wanted.size());
  for (std::uint32_t i = 0; i < input.cloud.size(); ++i)
    if (input.objects.of_point[i] >= 0 && wanted[static_cast<std::size_t>(input.objects.of_point[i])])
      points[static_cast<std::size_t>(input.objects.of_point[i])].push_back(i);
  const SeedSearch search(input, config);
  std::vector<std::vector<Candidate>> found(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t object) {
    if (!points[object].empty())
      search.add(points[object], static_cast<std::int32_t>(object), round, found[object]);
  });
  for (const auto& more : found) candidates.insert(candidates.end(), more.begin(), more.end());
  return candidates;
}

}  // namespace graspd
