// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/find_handles.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "service/pipeline/object_outline.hpp"

namespace graspd {
namespace {

constexpr float kVoxelCell = 0.02f;  // of the grids for box queries [m]
constexpr float kPointCell = 0.015f;
constexpr int kVoxelTolerance =
    2;  // stray points a volume may have: counts are absolute, noise does not scale
constexpr int kPointTolerance = 4;

using Results = std::vector<CheckResult>;

/// The same place with the closing axis that the check found to meet the object squarely.
Candidate squared(const Candidate& candidate, const CheckResult& result) {
  Candidate better = candidate;
  const Eigen::Vector3f y = result.squared_axis;
  const Eigen::Vector3f x = result.handle.rotation.col(0);
  better.position = result.handle.position;
  better.rotation.col(1) = y;
  better.rotation.col(0) = (x - x.dot(y) * y).normalized();
  better.rotation.col(2) = better.rotation.col(0).cross(y);
  return better;
}

/// Checks, and once more with the jaws square to the object where they were not; the better one counts.
CheckResult check_squarely(const SceneView& scene, const Gripper& gripper, const HandleCheckConfig& config,
                           const Candidate& candidate, CheckBuffers& buffers) {
  constexpr float kSquareCosine = 0.9986f;  // 3 degrees
  CheckResult result = check_candidate(scene, gripper, config, candidate, buffers);
  for (int round = 0; round < 2 && result.failure == Failure::kNone; ++round) {
    if (result.squared_axis.dot(result.handle.rotation.col(1)) > kSquareCosine) break;
    const CheckResult better = check_candidate(scene, gripper, config, squared(candidate, result), buffers);
    if (better.failure != Failure::kNone || score(better.margins) <= score(result.margins)) break;
    result = better;
  }
  return result;
}

/// How many of two places next to it along the major axis, and of two turned about the approach, hold too:
/// the robot and the cloud are a little off.
float steadiness(const SceneView& scene, const Gripper& gripper, const HandleCheckConfig& config,
                 const Candidate& candidate, const CheckResult& result, CheckBuffers& buffers) {
  constexpr float kShift = 0.003f, kTurn = 0.087f;
  int held = 0;
  for (const float sign : {-1.0f, 1.0f}) {
    Candidate shifted = candidate;
    shifted.position = result.handle.position + sign * kShift * result.handle.rotation.col(0);
    shifted.rotation = result.handle.rotation;
    held += check_candidate(scene, gripper, config, shifted, buffers).failure == Failure::kNone ? 1 : 0;
    Candidate turned = shifted;
    turned.position = result.handle.position;
    turned.rotation = result.handle.rotation * Eigen::AngleAxisf(sign * kTurn, Eigen::Vector3f::UnitZ());
    held += check_candidate(scene, gripper, config, turned, buffers).failure == Failure::kNone ? 1 : 0;
  }
  return 0.25f * static_cast<float>(held);
}

CheckResult check_thoroughly(const SceneView& scene, const Gripper& gripper, const HandleCheckConfig& config,
                             const Candidate& candidate, CheckBuffers& buffers) {
  CheckResult result = check_squarely(scene, gripper, config, candidate, buffers);
  if (result.failure == Failure::kNone)
    result.margins.steady = steadiness(scene, gripper, config, candidate, result, buffers);
  return result;
}

/// outlines: a first look, which refuses at little cost what is much too wide; null: the thorough one.
Results check_all(const SceneView& scene, const Gripper& gripper, const HandleCheckConfig& config,
                  const std::vector<Candidate>& candidates, const ObjectOutlines* outlines) {
  Results results(candidates.size());
  tbb::enumerable_thread_specific<CheckBuffers> buffers;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size(), 8), [&](const auto& range) {
    CheckBuffers& own = buffers.local();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Candidate& candidate = candidates[i];
      if (outlines && outlines->clearly_too_wide(candidate, gripper, own.local))
        results[i].failure = Failure::kTooWide;
      else
        results[i] = outlines ? check_candidate(scene, gripper, config, candidate, own)
                              : check_thoroughly(scene, gripper, config, candidate, own);
    }
  });
  return results;
}

std::vector<std::int32_t> spread_to_points(const std::vector<std::int32_t>& of_voxel,
                                           const std::vector<std::uint32_t>& voxel_of_point) {
  std::vector<std::int32_t> of_point(voxel_of_point.size());
  for (std::size_t i = 0; i < of_point.size(); ++i) of_point[i] = of_voxel[voxel_of_point[i]];
  return of_point;
}

/// Off the middle the object turns between the jaws: the margin falls off over 6 cm along the major axis.
RankedHandle scored(const CheckResult& result, const Eigen::Vector3f& center, int object) {
  constexpr float kFalloff = 0.06f;
  RankedHandle ranked{result.handle, object};
  HandleMargins margins = result.margins;
  const float off = result.handle.rotation.col(0).dot(center - result.handle.position) / kFalloff;
  margins.central = std::exp(-off * off);
  ranked.handle.score = score(margins);
  return ranked;
}

std::vector<SegmentReport> start_reports(const Surfaces& surfaces) {
  std::vector<SegmentReport> reports;
  for (std::size_t s = 0; s < surfaces.segments.list.size(); ++s) {
    const Segment& segment = surfaces.segments.list[s];
    SegmentReport& report = reports.emplace_back();
    report.centroid = segment.centroid;
    report.num_points = static_cast<int>(segment.points.size());
    report.object = surfaces.objects.of_segment[s];
  }
  return reports;
}

void count(const Candidate& candidate, Failure failure, CheckedCandidates& out) {
  ++out.num_tried;
  SegmentReport& report = out.segments[static_cast<std::size_t>(candidate.segment)];
  ++report.num_candidates;
  if (failure == Failure::kNone) {
    ++report.num_handles;
    return;
  }
  ++report.failures[static_cast<std::size_t>(failure)];
  ++out.failures[static_cast<std::size_t>(failure)];
}

/// The best by score of each object, ascending.
std::vector<std::size_t> best_of_objects(const std::vector<Candidate>& candidates,
                                         const std::vector<float>& scores, std::size_t most) {
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return scores[a] > scores[b]; });
  std::map<std::int32_t, std::size_t> taken;
  std::erase_if(order, [&](std::size_t i) { return ++taken[candidates[i].object] > most; });
  std::sort(order.begin(), order.end());
  return order;
}

/// The candidates that pass among the voxels, the most promising ones of each object; counts those that fail.
std::vector<Candidate> prefilter(const SceneView& voxels, const Gripper& gripper,
                                 const HandleCheckConfig& config, const std::vector<Candidate>& candidates,
                                 const ObjectOutlines& outlines, CheckedCandidates& out) {
  constexpr std::size_t kMostOfAnObject = 12;
  const Results coarse = check_all(voxels, gripper, config, candidates, &outlines);
  std::vector<Candidate> passed;
  std::vector<float> scores;
  passed.reserve(candidates.size());
  scores.reserve(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (coarse[i].failure != Failure::kNone) {
      count(candidates[i], coarse[i].failure, out);
      continue;
    }
    passed.push_back(candidates[i]);
    scores.push_back(score(coarse[i].margins));
  }
  // A few that passed among the voxels hold the few that are published.
  std::vector<Candidate> promising;
  promising.reserve(passed.size());
  for (const std::size_t i : best_of_objects(passed, scores, kMostOfAnObject)) promising.push_back(passed[i]);
  return promising;
}

/// An object with this many handles takes no part in a round.
int enough_before(SearchRound round) {
  switch (round) {
    case SearchRound::kSurface:
      return std::numeric_limits<int>::max();
    case SearchRound::kSurroundings:
      return 6;
    case SearchRound::kAllDirections:
      return 1;
  }
  return 0;
}

/// What voxels measure is off by up to half a voxel at either end: they refuse only what is clearly wrong.
HandleCheckConfig coarse_limits(HandleCheckConfig limits) {
  limits.max_silhouette_angle_deg = std::min(80.0f, limits.max_silhouette_angle_deg + 6);
  limits.max_wall_angle_deg = std::min(80.0f, limits.max_wall_angle_deg + 6);
  limits.max_facing_angle_deg = std::min(80.0f, limits.max_facing_angle_deg + 6);
  limits.min_own_share *= 0.97f;
  limits.min_contact_area_m2 *= 0.8f;
  return limits;
}

/// The cloud in both resolutions, with what finding points in boxes and behind others needs.
struct CheckedScene {
  const PointCloud& cloud;
  const Surfaces& surfaces;
  float voxel_area_m2;
  DepthMap depth_map;
  BoxQuery voxel_query, point_query;

  CheckedScene(const PointCloud& c, const Surfaces& s, const DetectConfig& config)
      : cloud(c),
        surfaces(s),
        voxel_area_m2(config.downsample.leaf_size_m * config.downsample.leaf_size_m),
        depth_map(c),
        voxel_query(s.cloud, kVoxelCell),
        point_query(c, kPointCell) {}
};

/// Searches the objects of one guess at what belongs together.
class GuessSearch {
 public:
  GuessSearch(const CheckedScene& scene, const Objects& objects, const Gripper& gripper,
              const DetectConfig& config)
      : scene_(scene),
        objects_(objects),
        gripper_(gripper),
        config_(config),
        object_of_point_(spread_to_points(objects.of_point, scene.surfaces.voxel_of_point)),
        outlines_(scene.surfaces.cloud, objects.of_point, objects.num_objects),
        coarse_check_(coarse_limits(config.check)),
        input_{scene.surfaces.cloud, scene.surfaces.normals, scene.surfaces.segments, objects,
               scene.surfaces.support},
        voxels_{scene.surfaces.cloud,   scene.voxel_query, objects.of_point,
                scene.surfaces.normals, nullptr,           scene.surfaces.support,
                scene.depth_map,        object_of_point_,  scene.voxel_area_m2,
                kVoxelTolerance},
        points_{scene.cloud,
                scene.point_query,
                object_of_point_,
                scene.surfaces.normals,
                &scene.surfaces.voxel_of_point,
                scene.surfaces.support,
                scene.depth_map,
                object_of_point_,
                scene.voxel_area_m2,
                kPointTolerance} {}

  /// wanted: 1 for each object to search. Adds to out.
  void run(const std::vector<std::uint8_t>& wanted, CheckedCandidates& out) const {
    const HandleSearch search(input_, gripper_, config_.search, wanted);
    std::vector<int> handles_of_object(wanted.size());
    for (const SearchRound round : kSearchRounds) {
      std::vector<std::uint8_t> open = wanted;
      for (std::size_t k = 0; k < open.size(); ++k)
        if (handles_of_object[k] >= enough_before(round)) open[k] = 0;
      const std::vector<Candidate> left =
          prefilter(voxels_, gripper_, coarse_check_, search.candidates(round, open), outlines_, out);
      const Results fine = check_all(points_, gripper_, config_.check, left, nullptr);
      for (std::size_t k = 0; k < left.size(); ++k) {
        count(left[k], fine[k].failure, out);
        if (fine[k].failure != Failure::kNone) continue;
        const auto object = static_cast<std::size_t>(left[k].object);
        out.handles.push_back(scored(fine[k], objects_.center[object], left[k].object));
        ++handles_of_object[object];
      }
    }
  }

 private:
  const CheckedScene& scene_;
  const Objects& objects_;
  const Gripper& gripper_;
  const DetectConfig& config_;
  std::vector<std::int32_t> object_of_point_;
  ObjectOutlines outlines_;
  HandleCheckConfig coarse_check_;
  SearchInput input_;
  SceneView voxels_, points_;
};

/// 1 for each whole of several objects of which one has no handle.
std::vector<std::uint8_t> wholes_to_try(const Surfaces& surfaces, const CheckedCandidates& found) {
  const std::vector<std::int32_t>&object = surfaces.objects.of_segment, &whole = surfaces.wholes.of_segment;
  std::vector<std::uint8_t> has_handle(static_cast<std::size_t>(surfaces.objects.num_objects));
  for (const RankedHandle& ranked : found.handles) has_handle[static_cast<std::size_t>(ranked.object)] = 1;
  std::vector<std::int32_t> first(static_cast<std::size_t>(surfaces.wholes.num_objects), -1);
  std::vector<std::uint8_t> several(first.size()), lacking(first.size());
  for (std::size_t s = 0; s < object.size(); ++s) {
    const auto w = static_cast<std::size_t>(whole[s]);
    if (first[w] < 0) first[w] = object[s];
    if (object[s] != first[w]) several[w] = 1;
    if (!has_handle[static_cast<std::size_t>(object[s])]) lacking[w] = 1;
  }
  for (std::size_t w = 0; w < several.size(); ++w) several[w] &= lacking[w];
  return several;
}

/// Adds the best handle of a whole on each of its parts that has none, as that part's.
void add_for_parts_without(const Surfaces& surfaces, const std::vector<RankedHandle>& of_wholes,
                           std::vector<RankedHandle>& handles) {
  const auto part = [&](const RankedHandle& ranked) {
    return surfaces.objects.of_segment[static_cast<std::size_t>(ranked.handle.segment)];
  };
  std::set<std::int32_t> served;
  for (const RankedHandle& ranked : handles) served.insert(ranked.object);
  std::map<std::int32_t, RankedHandle> best;
  for (const RankedHandle& ranked : of_wholes) {
    if (served.contains(part(ranked))) continue;
    const auto [it, is_new] = best.try_emplace(part(ranked), ranked);
    if (!is_new && ranked.handle.score > it->second.handle.score) it->second = ranked;
  }
  for (auto& [object, ranked] : best) {
    ranked.object = object;
    handles.push_back(ranked);
  }
}

}  // namespace

CheckedCandidates find_handles(const PointCloud& cloud, const Surfaces& surfaces, const Gripper& gripper,
                               const DetectConfig& config) {
  const CheckedScene scene(cloud, surfaces, config);
  CheckedCandidates out;
  out.segments = start_reports(surfaces);
  const std::vector<std::uint8_t> all(static_cast<std::size_t>(surfaces.objects.num_objects), 1);
  GuessSearch(scene, surfaces.objects, gripper, config).run(all, out);
  const std::vector<std::uint8_t> wholes = wholes_to_try(surfaces, out);
  if (std::none_of(wholes.begin(), wholes.end(), [](std::uint8_t w) { return w != 0; })) return out;
  std::vector<RankedHandle> found = std::move(out.handles);
  out.handles.clear();
  GuessSearch(scene, surfaces.wholes, gripper, config).run(wholes, out);
  add_for_parts_without(surfaces, out.handles, found);
  out.handles = std::move(found);
  return out;
}

}  // namespace graspd
