// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/handle_search.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "service/pipeline/cell_order.hpp"
#include "service/pipeline/near_points.hpp"
#include "service/pipeline/rim_search.hpp"
#include "service/pipeline/thin_out.hpp"

namespace graspd {
namespace {

constexpr std::size_t kMostSeedsInAllDirections = 16;

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
  constexpr int kAngles = 36;
  constexpr std::size_t kMaxPoints = 400;
  std::array<float, 2 * kMaxPoints> x, y, u, v;  // a step is at least half of what it would have to be
  std::size_t n = 0;
  const std::size_t step = std::max<std::size_t>(1, segment.points.size() / kMaxPoints);
  for (std::size_t k = 0; k < segment.points.size(); k += step) {
    const Eigen::Vector3f d = cloud.point(segment.points[k]) - segment.centroid;
    x[n] = d.dot(segment.major);
    y[n++] = d.dot(segment.minor);
  }
  float best_area = std::numeric_limits<float>::infinity();
  Eigen::Vector3f best = segment.major;
  for (int i = 0; i < kAngles; ++i) {
    const float angle = std::numbers::pi_v<float> / 2 * static_cast<float>(i) / kAngles;
    const float c = std::cos(angle), s = std::sin(angle);
    for (std::size_t k = 0; k < n; ++k) {
      u[k] = c * x[k] + s * y[k];
      v[k] = c * y[k] - s * x[k];
    }
    float low_u = 1e9f, high_u = -1e9f, low_v = 1e9f, high_v = -1e9f;
    point_kernels().extend_bounds(u.data(), n, low_u, high_u);
    point_kernels().extend_bounds(v.data(), n, low_v, high_v);
    const float area = (high_u - low_u) * (high_v - low_v);
    if (area >= best_area) continue;
    best_area = area;
    best = c * segment.major + s * segment.minor;
  }
  return best;
}

/// Mean normal of the object's voxels near a seed.
Eigen::Vector3f face_normal(const Normals& normals, const NearPoints& object, const Eigen::Vector3f& p,
                            const Eigen::Vector3f& n, NearPoints::Buffer& buffer) {
  constexpr float kRadius = 0.015f;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const std::uint32_t i : object.within(p, kRadius, buffer))
    if (normals.at(i).dot(n) > 0.8f) sum += normals.at(i);
  return sum.norm() > 1e-3f ? sum.normalized() : n;
}

}  // namespace

void FewDirections::add_distinct(const Eigen::Vector3f& v, float max_cosine, bool signless) {
  if (!(v.norm() > 1e-3f)) return;
  const Eigen::Vector3f unit = v.normalized();
  for (const Eigen::Vector3f& other : all()) {
    const float cosine = unit.dot(other);
    if ((signless ? std::abs(cosine) : cosine) > max_cosine) return;
  }
  add(unit);
}

HandleSearch::HandleSearch(const SearchInput& input, const Gripper& gripper, const HandleSearchConfig& config,
                           const std::pmr::vector<std::uint8_t>& wanted)
    : in_(input),
      wanted_(wanted),
      gripper_(gripper),
      config_(config),
      max_cosine_(std::cos(config.distinct_angle_deg * std::numbers::pi_v<float> / 180)),
      rectangle_axes_(input.segments.list.size()),
      seeds_(static_cast<std::size_t>(input.objects.num_objects)) {
  if (!config.seeds) return;
  tbb::parallel_for(std::size_t{0}, rectangle_axes_.size(), [&](std::size_t s) {
    if (wanted_[s] != 0) rectangle_axes_[s] = rectangle_axis(in_.cloud, in_.segments.list[s]);
  });
  const std::pmr::vector<std::uint8_t> open = objects_with_segments(in_.objects, wanted_);
  tbb::parallel_for(std::size_t{0}, seeds_.size(), [&](std::size_t k) {
    if (open[k] != 0) seeds_[k] = spread_seeds(in_.object_points.of(k));
  });
}

std::pmr::vector<HandleSearch::Seed> HandleSearch::spread_seeds(std::span<const std::uint32_t> points) const {
  std::pmr::vector<Seed> seeds;
  for (const std::uint32_t p : thin_out(in_.cloud, points, config_.seed_spacing_m)) {
    const std::int32_t s = in_.segments.of_point[p];
    if (s >= 0 && wanted_[static_cast<std::size_t>(s)] != 0) seeds.push_back({p, {}});
  }
  const NearPoints object(in_.cloud, points);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, seeds.size(), 16), [&](const auto& range) {
    NearPoints::Buffer buffer;
    for (std::size_t k = range.begin(); k != range.end(); ++k) {
      const std::uint32_t p = seeds[k].point;
      seeds[k].outward = outward_directions(
          p, face_normal(in_.normals, object, in_.cloud.point(p), in_.normals.at(p), buffer));
    }
  });
  return seeds;
}

FewDirections HandleSearch::outward_directions(std::uint32_t seed, const Eigen::Vector3f& n) const {
  const Eigen::Vector3f to_sensor = (in_.cloud.viewpoint - in_.cloud.point(seed)).normalized();
  FewDirections suggested, outward;
  suggested.add_distinct(n, max_cosine_, false);
  if (in_.support) {
    suggested.add_distinct(in_.support->plane.normal, max_cosine_, false);
    suggested.add_distinct(n + in_.support->plane.normal, max_cosine_, false);
  }
  suggested.add_distinct(to_sensor, max_cosine_, false);
  for (const Eigen::Vector3f& o : suggested.all())
    if (!(o.dot(to_sensor) < config_.min_facing_cosine)) outward.add(o);
  return outward;
}

FewDirections HandleSearch::major_axes(std::size_t s, const Eigen::Vector3f& outward) const {
  const Segment& segment = in_.segments.list[s];
  FewDirections axes;
  const auto add = [&](const Eigen::Vector3f& axis) {
    const Eigen::Vector3f across = axis - axis.dot(outward) * outward;
    if (across.norm() < 0.3f) return;
    axes.add_distinct(across, max_cosine_, true);
    axes.add_distinct(across.cross(outward), max_cosine_, true);
  };
  add(rectangle_axes_[s]);
  add(segment.normal.cross(rectangle_axes_[s]));
  add(segment.major);
  add(segment.minor);
  if (in_.support) {
    add(in_.support->plane.normal);
    add(in_.support->plane.normal.cross(outward));
  }
  return axes;
}

/// Evenly spread axes, less those that were tried.
HandleSearch::Directions HandleSearch::other_axes(const Eigen::Vector3f& outward,
                                                  const FewDirections& tried) const {
  const Eigen::Vector3f u = outward.unitOrthogonal(), v = outward.cross(u);
  Directions axes;
  for (int i = 0; i < config_.all_directions; ++i) {
    const float angle =
        std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(config_.all_directions);
    const Eigen::Vector3f axis = std::cos(angle) * u + std::sin(angle) * v;
    const auto same = [&](const Eigen::Vector3f& t) { return std::abs(t.dot(axis)) > max_cosine_; };
    if (std::ranges::none_of(tried.all(), same)) axes.push_back(axis);
  }
  return axes;
}

/// One candidate a band of width e along an axis of the segment, from the centroid both ways (paper, section
/// 5).
void HandleSearch::add_bands(std::size_t s, const Eigen::Vector3f& axis,
                             std::pmr::vector<Candidate>& out) const {
  constexpr int kMinBandPoints = 8;
  struct Band {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    int n = 0;
  };
  const Segment& segment = in_.segments.list[s];
  const auto along = [&](std::uint32_t i) {
    return axis.dot(in_.cloud.point(i) - segment.centroid) / gripper_.finger_thickness_m;
  };
  RawVector<float> places(segment.points.size());
  float reach = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    places[k] = along(segment.points[k]);
    reach = std::max(reach, std::abs(places[k]));
  }
  const auto rounded = [](float place) { return cell_index(place + 0.5f, 1); };
  const int half = rounded(reach);
  std::pmr::vector<Band> bands(static_cast<std::size_t>(2 * half + 1));
  for (std::size_t k = 0; k < places.size(); ++k) {
    Band& band = bands[static_cast<std::size_t>(std::clamp(rounded(places[k]) + half, 0, 2 * half))];
    band.sum += in_.cloud.point(segment.points[k]);
    ++band.n;
  }
  for (const Band& band : bands)
    if (band.n >= kMinBandPoints)
      out.push_back({band.sum / static_cast<float>(band.n), gripper_axes(segment.normal, axis),
                     static_cast<std::int32_t>(s), in_.objects.of_segment[s]});
}

void HandleSearch::add_seeds(std::size_t object, SearchRound round, std::pmr::vector<Candidate>& out) const {
  const std::pmr::vector<Seed>& seeds = seeds_[object];
  const bool all = round == SearchRound::kAllDirections;
  const std::size_t num_seeds = all ? std::min(kMostSeedsInAllDirections, seeds.size()) : seeds.size();
  for (std::size_t k = 0; k < num_seeds; ++k) {
    const Seed& seed = seeds[k * seeds.size() / num_seeds];
    const std::int32_t s = in_.segments.of_point[seed.point];
    constexpr std::size_t kFirst = 2;  // outward directions and axes
    const bool is_first_round = round == SearchRound::kSurface;
    const std::size_t num_outward =
        all || is_first_round ? std::min(kFirst, seed.outward.size()) : seed.outward.size();
    for (std::size_t o = 0; o < num_outward; ++o) {
      const FewDirections suggested = major_axes(static_cast<std::size_t>(s), seed.outward[o]);
      const Directions others = all ? other_axes(seed.outward[o], suggested) : Directions{};
      const std::span<const Eigen::Vector3f> axes = all ? others : suggested.all();
      // The surface's own normal and axes first (paper, section 5), the support's normal next to them.
      for (std::size_t a = 0; a < axes.size(); ++a) {
        const bool is_first = o < kFirst && a < kFirst;
        if (all || is_first == is_first_round)
          out.push_back({in_.cloud.point(seed.point), gripper_axes(seed.outward[o], axes[a]), s,
                         static_cast<std::int32_t>(object)});
      }
    }
  }
}

std::pmr::vector<Candidate> HandleSearch::candidates(SearchRound round,
                                                     const std::pmr::vector<std::uint8_t>& open) const {
  // Of the segments, then of the objects.
  const std::size_t num_segments = in_.segments.list.size();
  std::pmr::vector<std::pmr::vector<Candidate>> parts(num_segments + seeds_.size());
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) {
    if (k >= num_segments) {
      if (const std::size_t object = k - num_segments; open[object] != 0) {
        add_seeds(object, round, parts[k]);
        if (config_.seeds && round == SearchRound::kSurface) {
          const auto rims = rim_candidates(in_, object, gripper_, config_);
          parts[k].insert(parts[k].end(), rims.begin(), rims.end());
        }
      }
    } else if (config_.bands && round == SearchRound::kSurface && wanted_[k] != 0 &&
               open[static_cast<std::size_t>(in_.objects.of_segment[k])] != 0) {
      add_bands(k, in_.segments.list[k].major, parts[k]);
      add_bands(k, in_.segments.list[k].minor, parts[k]);
    }
  });
  std::pmr::vector<Candidate> candidates;
  for (const std::pmr::vector<Candidate>& part : parts)
    candidates.insert(candidates.end(), part.begin(), part.end());
  return candidates;
}

}  // namespace graspd
