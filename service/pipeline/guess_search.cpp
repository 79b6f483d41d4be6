// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/guess_search.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "service/pipeline/careful_check.hpp"

namespace graspd {
namespace {

constexpr float kPointCell = 0.015f;  // of the grid for box queries [m]
// Stray points a volume may have: counts are absolute, noise does not scale.
constexpr int kSparseTolerance = 2, kPointTolerance = 4;
constexpr int kMinSparse = 6, kMinPoints = 12;  // of the object between the jaws

using Results = std::pmr::vector<CheckResult>;

/// outlines: a first look, which refuses at little cost what is much too wide; null: the thorough one.
Results check_all(const SceneView& scene, const Gripper& gripper, const HandleCheckConfig& config,
                  const std::pmr::vector<Candidate>& candidates, const ObjectOutlines* outlines) {
  Results results(candidates.size());
  tbb::enumerable_thread_specific<CheckBuffers, std::pmr::polymorphic_allocator<CheckBuffers>> buffers;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size(), 8), [&](const auto& range) {
    CheckBuffers& own = buffers.local();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Candidate& candidate = candidates[i];
      if (outlines && outlines->clearly_too_wide(candidate, gripper, own.local))
        results[i].failure = Failure::kTooWide;
      else
        results[i] = outlines ? check_candidate(scene, gripper, config, candidate, own)
                              : check_squarely(scene, gripper, config, candidate, own);
    }
  });
  return results;
}

std::pmr::vector<std::int32_t> spread_to_points(const std::pmr::vector<std::int32_t>& of_voxel,
                                                const std::pmr::vector<std::uint32_t>& voxel_of_point) {
  std::pmr::vector<std::int32_t> of_point(voxel_of_point.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, of_point.size(), 16384), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) of_point[i] = of_voxel[voxel_of_point[i]];
  });
  return of_point;
}

FoundHandle scored(const CheckResult& result, const Objects& guess, int object, const SceneView& scene) {
  FoundHandle found{{result.handle, object}, result.margins, &scene, &guess, object};
  found.margins.central = centrality(result.handle, guess.center[static_cast<std::size_t>(object)]);
  found.ranked.handle.score = score(found.margins);
  return found;
}

void count(const Candidate& candidate, Failure failure, SearchResult& out) {
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
std::pmr::vector<std::size_t> best_of_objects(const std::pmr::vector<Candidate>& candidates,
                                              const std::pmr::vector<float>& scores, std::size_t most) {
  std::pmr::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return scores[a] != scores[b] ? scores[a] > scores[b] : a < b;
  });
  std::pmr::map<std::int32_t, std::size_t> taken;
  std::erase_if(order, [&](std::size_t i) { return ++taken[candidates[i].object] > most; });
  std::sort(order.begin(), order.end());
  return order;
}

/// The candidates that pass in the sparse copy, the most promising ones of each object; counts those that
/// fail.
std::pmr::vector<Candidate> prefilter(const SceneView& sparse, const Gripper& gripper,
                                      const HandleCheckConfig& config,
                                      const std::pmr::vector<Candidate>& candidates,
                                      const ObjectOutlines& outlines, SearchResult& out) {
  constexpr std::size_t kMostOfAnObject = 12;
  const Results coarse = check_all(sparse, gripper, config, candidates, &outlines);
  std::pmr::vector<Candidate> passed;
  std::pmr::vector<float> scores;
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
  // A few that passed in the sparse copy hold the few that are published.
  std::pmr::vector<Candidate> promising;
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

/// What a sparse copy measures is off by up to half its spacing at either end: it refuses only what is
/// clearly wrong.
HandleCheckConfig coarse_limits(HandleCheckConfig limits) {
  limits.max_silhouette_angle_deg = std::min(80.0f, limits.max_silhouette_angle_deg + 6);
  limits.max_wall_angle_deg = std::min(80.0f, limits.max_wall_angle_deg + 6);
  limits.max_facing_angle_deg = std::min(80.0f, limits.max_facing_angle_deg + 6);
  limits.min_own_share *= 0.97f;
  limits.min_contact_area_m2 *= 0.8f;
  return limits;
}

}  // namespace

float centrality(const Handle& handle, const Eigen::Vector3f& object_center) {
  constexpr float kFalloff = 0.06f;
  const float off = handle.rotation.col(0).dot(object_center - handle.position) / kFalloff;
  return std::exp(-off * off);
}

PointIndex::PointIndex(const PointCloud& cloud, const ImagePixels& pixels)
    : depth_map(cloud, pixels), query(cloud, kPointCell) {}

GuessSearch::GuessSearch(const CheckedScene& scene, const Objects& objects, const Gripper& gripper,
                         const DetectConfig& config)
    : objects_(objects),
      gripper_(gripper),
      config_(config),
      object_of_point_(spread_to_points(objects.of_point, scene.surfaces.voxel_of_point)),
      object_of_sparse_(spread_to_points(objects.of_point, scene.surfaces.sparse.voxel)),
      outlines_(scene.surfaces.cloud, objects.of_point, objects.num_objects),
      coarse_check_(coarse_limits(config.check)),
      input_{scene.surfaces.cloud, scene.surfaces.normals, scene.surfaces.segments, objects,
             scene.surfaces.support},
      sparse_{scene.surfaces.sparse.cloud,
              scene.surfaces.sparse.query,
              object_of_sparse_,
              scene.surfaces.normals,
              scene.surfaces.sparse.voxel,
              scene.surfaces.support,
              scene.index.depth_map,
              object_of_point_,
              kSparseTolerance,
              kMinSparse,
              scene.surfaces.sparse.spacing_m},
      points_{scene.cloud,
              scene.index.query,
              object_of_point_,
              scene.surfaces.normals,
              scene.surfaces.voxel_of_point,
              scene.surfaces.support,
              scene.index.depth_map,
              object_of_point_,
              kPointTolerance,
              kMinPoints} {}

void GuessSearch::run(const std::pmr::vector<std::uint8_t>& wanted, SearchResult& out) const {
  const HandleSearch search(input_, gripper_, config_.search, wanted);
  std::pmr::vector<int> handles_of_object(wanted.size());
  for (const SearchRound round : kSearchRounds) {
    std::pmr::vector<std::uint8_t> open = wanted;
    for (std::size_t k = 0; k < open.size(); ++k)
      if (handles_of_object[k] >= enough_before(round)) open[k] = 0;
    const std::pmr::vector<Candidate> left =
        prefilter(sparse_, gripper_, coarse_check_, search.candidates(round, open), outlines_, out);
    const Results fine = check_all(points_, gripper_, config_.check, left, nullptr);
    for (std::size_t k = 0; k < left.size(); ++k) {
      count(left[k], fine[k].failure, out);
      if (fine[k].failure != Failure::kNone) continue;
      const auto object = static_cast<std::size_t>(left[k].object);
      out.handles.push_back(scored(fine[k], objects_, left[k].object, points_));
      ++handles_of_object[object];
    }
  }
}

}  // namespace graspd
