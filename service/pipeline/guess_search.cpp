// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/guess_search.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "service/pipeline/careful_check.hpp"

namespace graspd {
namespace {

// Stray points a volume may have: counts are absolute, noise does not scale.
constexpr int kSparseTolerance = 2, kPointTolerance = 4;
constexpr int kMinSparse = 6, kMinPoints = 12;  // of the object between the jaws

// The thorough look is taken at a few of the candidates of an object that passed the first look, the most
// promising ones first, and at a few more as long as it has few handles: the few that are published are among
// them.
constexpr std::size_t kAtOnce = 6, kEnoughHandles = 4, kMostOfAnObject = 18;

// The first look is taken at the candidates on a segment in so many parts, each spread over all of them.
constexpr std::size_t kParts = 16;

FoundHandle scored(const CheckResult& result, const Guess& guess, const Candidate& candidate,
                   const SceneView& scene, const SceneView& sparse) {
  const int object = candidate.object;
  FoundHandle found{{result.handle, object}, result.margins, &scene, &sparse, &guess, candidate};
  rate(found, guess.objects.center[static_cast<std::size_t>(object)]);
  return found;
}

/// A candidate that passed the first look.
struct Promising {
  Candidate candidate;
  float score;
  Eigen::Vector3f position;  ///< that it was fitted to
  std::size_t rank = 0;      ///< among those of its object, from 0
};

/// Which of the candidates around one place each is, the best one 0. order: the best ones first.
std::pmr::vector<std::size_t> turns_at_places(const std::pmr::vector<Promising>& all,
                                              const std::pmr::vector<std::size_t>& order) {
  constexpr float kSamePlace = 0.03f;  // from its best candidate [m]
  struct Place {
    Eigen::Vector3f position;
    std::size_t num = 0;
  };
  std::pmr::map<std::int32_t, std::pmr::vector<Place>> places_of_object;
  std::pmr::vector<std::size_t> turns(all.size());
  for (const std::size_t i : order) {
    std::pmr::vector<Place>& places = places_of_object[all[i].candidate.object];
    auto here = std::find_if(places.begin(), places.end(), [&](const Place& place) {
      return (place.position - all[i].position).squaredNorm() < kSamePlace * kSamePlace;
    });
    if (here == places.end()) here = places.insert(here, {all[i].position});
    turns[i] = here->num++;
  }
  return turns;
}

/// The best candidates of all places of an object first, then the second ones: what is taken for one object
/// may be two, and one that is easy to take must not keep the other from its turn.
void set_ranks(std::pmr::vector<Promising>& all) {
  std::pmr::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return all[a].score != all[b].score ? all[a].score > all[b].score : a < b;
  });
  const std::pmr::vector<std::size_t> turns = turns_at_places(all, order);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(turns[a], -all[a].score, a) < std::tuple(turns[b], -all[b].score, b);
  });
  std::pmr::map<std::int32_t, std::size_t> seen;
  for (const std::size_t i : order) all[i].rank = seen[all[i].candidate.object]++;
}

/// What is kept of a first look.
struct FirstLook {
  bool is_taken = false;
  Failure failure = Failure::kNone;
  // Of those that passed.
  float score = 0;
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  // fitted

  FirstLook() = default;
  explicit FirstLook(const CheckResult& result) : is_taken(true), failure(result.failure) {
    if (failure != Failure::kNone) return;
    score = graspd::score(result.margins);
    position = result.handle.position;
  }
};

/// What the first looks at a segment came to.
struct Tally {
  std::size_t looked_at = 0, had_room = 0, passed = 0;

  void count(Failure failure) {
    ++looked_at;
    if (failure > Failure::kFingers) ++had_room;
    if (failure == Failure::kNone) ++passed;
  }
  /// Whether the rest would say the same: plenty passed, or hardly one of many found room for the fingers.
  [[nodiscard]] bool is_clear() const {
    constexpr std::size_t kPlenty = 8, kMany = 24, kHardlyOneIn = 20;
    return passed >= kPlenty || (looked_at >= kMany && had_room * kHardlyOneIn < looked_at);
  }
};

/// The candidates that pass the first look; counts those that fail. It is taken at every kParts-th candidate
/// on a segment at a time, until they tell what the segment comes to.
template <class Check>
std::pmr::vector<Promising> promising_ones(const std::pmr::vector<Candidate>& candidates, const Check& check,
                                           SearchResult& out) {
  std::pmr::vector<std::pmr::vector<std::uint32_t>> of_segment(out.segments.size()), parts(kParts);
  for (std::uint32_t i = 0; i < candidates.size(); ++i) {
    auto& own = of_segment[static_cast<std::size_t>(candidates[i].segment)];
    parts[own.size() % kParts].push_back(i);
    own.push_back(i);
  }
  std::pmr::vector<FirstLook> looks(candidates.size());
  tbb::parallel_for(std::size_t{0}, of_segment.size(), [&](std::size_t s) {
    const std::pmr::vector<std::uint32_t>& own = of_segment[s];
    Tally tally;
    for (std::size_t part = 0; part < std::min(kParts, own.size()) && !tally.is_clear(); ++part) {
      const std::size_t num = (own.size() - part + kParts - 1) / kParts;
      const auto nth = [&](std::size_t k) { return own[part + k * kParts]; };
      tbb::parallel_for(std::size_t{0}, num,
                        [&](std::size_t k) { looks[nth(k)] = FirstLook(check(candidates[nth(k)])); });
      for (std::size_t k = 0; k < num; ++k) tally.count(looks[nth(k)].failure);
    }
  });
  std::pmr::vector<Promising> passed;
  for (const std::pmr::vector<std::uint32_t>& part : parts)
    for (const std::uint32_t i : part) {
      if (!looks[i].is_taken) continue;
      if (looks[i].failure == Failure::kNone)
        passed.push_back({candidates[i], looks[i].score, looks[i].position});
      else
        out.count(candidates[i].segment, looks[i].failure);
    }
  set_ranks(passed);
  return passed;
}

/// The candidates of the next ranks on objects that have too few handles.
std::pmr::vector<Candidate> next_ones(const std::pmr::vector<Promising>& promising, std::size_t rank,
                                      const std::pmr::vector<std::size_t>& num_handles) {
  std::pmr::vector<Candidate> next;
  for (const Promising& p : promising)
    if (p.rank >= rank && p.rank < rank + kAtOnce &&
        num_handles[static_cast<std::size_t>(p.candidate.object)] < kEnoughHandles)
      next.push_back(p.candidate);
  return next;
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

/// Nothing where there is one level only.
std::pmr::vector<std::uint32_t> levels_of_objects(const PointCloud& cloud,
                                                  const std::optional<Support>& support, const Guess& guess) {
  std::pmr::vector<std::uint32_t> levels;
  if (!support || support->levels.empty()) return levels;
  const auto is_lower = [&](std::uint32_t a, std::uint32_t b) {
    return support->plane.height(cloud.point(a)) < support->plane.height(cloud.point(b));
  };
  for (std::size_t k = 0; k < guess.objects.center.size(); ++k) {
    const std::span<const std::uint32_t> points = guess.points.of(k);
    levels.push_back(points.empty() ? 0
                                    : level_under(support->levels, guess.objects.center[k],
                                                  cloud.point(*std::ranges::min_element(points, is_lower))));
  }
  return levels;
}

}  // namespace

float centrality(const Handle& handle, const Eigen::Vector3f& object_center,
                 const std::optional<Support>& support) {
  constexpr float kLittle = 0.03f, kFalloff = 0.04f, kPadMiddle = 0.015f;  // [m]
  const Eigen::Matrix3f& axes = handle.rotation;
  const Eigen::Vector3f from_pads = object_center - handle.position - kPadMiddle * axes.col(2);
  const Eigen::Vector3f across =
      support ? Eigen::Vector3f(support->plane.normal.cross(axes.col(1))) : Eigen::Vector3f(axes.col(0));
  const float lever = std::max(0.0f, std::abs(across.dot(from_pads)) - kLittle) / kFalloff;
  return std::exp(-lever * lever);
}

void rate(FoundHandle& found, const Eigen::Vector3f& object_center) {
  RankedHandle& ranked = found.ranked;
  ranked.central = found.margins.central = centrality(ranked.handle, object_center, found.scene->support);
  ranked.handle.score = score(found.margins);
}

void SearchResult::count(std::int32_t segment, Failure failure) {
  ++num_tried;
  SegmentReport& report = segments[static_cast<std::size_t>(segment)];
  ++report.num_candidates;
  if (failure == Failure::kNone) {
    ++report.num_handles;
    return;
  }
  ++report.failures[static_cast<std::size_t>(failure)];
  ++failures[static_cast<std::size_t>(failure)];
}

GuessSearch::GuessSearch(const CheckedScene& scene, const Objects& objects, const Gripper& gripper,
                         const DetectConfig& config)
    : guess_{objects, points_by_object(objects)},
      level_of_object_(levels_of_objects(scene.surfaces.cloud, scene.surfaces.support, guess_)),
      gripper_(gripper),
      config_(config),
      outlines_(scene.surfaces.cloud, guess_.points),
      coarse_check_(coarse_limits(config.check)),
      input_{scene.surfaces.cloud, scene.surfaces.normals, scene.surfaces.segments, objects,
             guess_.points,        scene.surfaces.support},
      sparse_{scene.surfaces.sparse.cloud,
              scene.surfaces.sparse.query,
              objects.of_point,
              scene.surfaces.normals,
              scene.far_sides.voxel_of_sparse,
              scene.surfaces.support,
              scene.depth_map,
              scene.surfaces.voxel_of_point,
              kSparseTolerance,
              kMinSparse,
              scene.surfaces.sparse.spacing_m,
              &scene.far_sides,
              &scene.surfaces.segments,
              level_of_object_},
      points_{scene.cloud,
              scene.surfaces.points,
              objects.of_point,
              scene.surfaces.normals,
              scene.far_sides.voxel_of_point,
              scene.surfaces.support,
              scene.depth_map,
              scene.surfaces.voxel_of_point,
              kPointTolerance,
              kMinPoints,
              0,
              &scene.far_sides,
              &scene.surfaces.segments,
              level_of_object_} {}

void GuessSearch::run(const std::pmr::vector<std::uint8_t>& wanted, CheckBuffersOfThreads& buffers,
                      SearchResult& out) const {
  const HandleSearch search(input_, gripper_, config_.search, wanted);
  const std::pmr::vector<std::uint8_t> all = objects_with_segments(guess_.objects, wanted);
  std::pmr::vector<std::size_t> num_handles(all.size());
  for (const SearchRound round : kSearchRounds) {
    std::pmr::vector<std::uint8_t> open = all;
    for (std::size_t k = 0; k < open.size(); ++k)
      if (num_handles[k] > 0) open[k] = 0;
    const std::pmr::vector<Candidate> candidates = search.candidates(round, open);
    const auto first_look = [&](const Candidate& candidate) {
      CheckBuffers& own = buffers.local();
      return outlines_.clearly_too_wide(candidate, gripper_, own.local)
                 ? CheckResult{Failure::kTooWide, {}, {}}
                 : check_candidate(sparse_, gripper_, coarse_check_, candidate, own);
    };
    const std::pmr::vector<Promising> promising = promising_ones(candidates, first_look, out);
    for (std::size_t rank = 0; rank < kMostOfAnObject; rank += kAtOnce) {
      const std::pmr::vector<Candidate> next = next_ones(promising, rank, num_handles);
      std::pmr::vector<CheckResult> fine(next.size());
      tbb::parallel_for(std::size_t{0}, next.size(), [&](std::size_t k) {
        fine[k] = check_squarely(points_, gripper_, config_.check, next[k], buffers.local());
      });
      for (std::size_t k = 0; k < next.size(); ++k) {
        out.count(next[k].segment, fine[k].failure);
        if (fine[k].failure != Failure::kNone) continue;
        out.handles.push_back(scored(fine[k], guess_, next[k], points_, sparse_));
        ++num_handles[static_cast<std::size_t>(next[k].object)];
      }
    }
  }
}

}  // namespace graspd
