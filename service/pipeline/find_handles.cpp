// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/find_handles.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "service/pipeline/careful_check.hpp"
#include "service/pipeline/first_handle.hpp"

namespace graspd {
namespace {

std::pmr::vector<SegmentReport> start_reports(const Surfaces& surfaces) {
  std::pmr::vector<SegmentReport> reports;
  for (std::size_t s = 0; s < surfaces.segments.list.size(); ++s) {
    const Segment& segment = surfaces.segments.list[s];
    SegmentReport& report = reports.emplace_back();
    report.centroid = segment.centroid;
    report.normal = segment.normal;
    report.major = segment.major;
    report.num_points = static_cast<int>(segment.points.size());
    report.object = surfaces.objects.of_segment[s];
  }
  return reports;
}

/// 1 for each segment of objects without a handle that are part of a whole of several.
std::pmr::vector<std::uint8_t> segments_to_try(const Surfaces& surfaces,
                                               const std::pmr::vector<FoundHandle>& handles) {
  const std::pmr::vector<std::int32_t>&object = surfaces.objects.of_segment,
        &whole = surfaces.wholes.of_segment;
  std::pmr::vector<std::uint8_t> has_handle(static_cast<std::size_t>(surfaces.objects.num_objects));
  for (const FoundHandle& found : handles) has_handle[static_cast<std::size_t>(found.ranked.object)] = 1;
  std::pmr::vector<std::int32_t> first(static_cast<std::size_t>(surfaces.wholes.num_objects), -1);
  std::pmr::vector<std::uint8_t> several(first.size()), wanted(object.size());
  for (std::size_t s = 0; s < object.size(); ++s) {
    const auto w = static_cast<std::size_t>(whole[s]);
    if (first[w] < 0) first[w] = object[s];
    if (object[s] != first[w]) several[w] = 1;
  }
  for (std::size_t s = 0; s < object.size(); ++s)
    wanted[s] = several[static_cast<std::size_t>(whole[s])] != 0 &&
                        has_handle[static_cast<std::size_t>(object[s])] == 0
                    ? 1
                    : 0;
  return wanted;
}

/// Looks at how steady handles are.
class Settler {
 public:
  Settler(const Gripper& gripper, const HandleCheckConfig& config, CheckBuffersOfThreads& buffers)
      : gripper_(gripper), config_(config), buffers_(buffers) {}

  /// The score with the steadiness in it.
  float final_score(const FoundHandle& found) {
    HandleMargins margins = found.margins;
    margins.steady = steadiness(*found.sparse, gripper_, config_, found.as_candidate(), buffers_.local());
    return score(margins);
  }

 private:
  const Gripper& gripper_;
  const HandleCheckConfig& config_;
  CheckBuffersOfThreads& buffers_;
};

/// Adds the best handle of a whole on each of its parts that has none, as that part's.
void add_for_parts_without(const Surfaces& surfaces, std::pmr::vector<FoundHandle> of_wholes,
                           Settler& settler, std::pmr::vector<FoundHandle>& handles) {
  std::pmr::set<std::int32_t> served;
  for (const FoundHandle& found : handles) served.insert(found.ranked.object);
  for (FoundHandle& found : of_wholes)
    found.ranked.object = surfaces.objects.of_segment[static_cast<std::size_t>(found.ranked.handle.segment)];
  std::erase_if(of_wholes, [&](const FoundHandle& found) { return served.contains(found.ranked.object); });
  std::pmr::vector<float> scores(of_wholes.size());
  tbb::parallel_for(std::size_t{0}, scores.size(),
                    [&](std::size_t i) { scores[i] = settler.final_score(of_wholes[i]); });
  std::pmr::map<std::int32_t, std::size_t> best;
  for (std::size_t i = 0; i < of_wholes.size(); ++i) {
    const auto [it, is_new] = best.try_emplace(of_wholes[i].ranked.object, i);
    if (!is_new && scores[i] > scores[it->second]) it->second = i;
  }
  for (const auto& [object, i] : best) handles.push_back(of_wholes[i]);
}

}  // namespace

FoundHandles find_handles(const PointCloud& cloud, const DepthMap& depth_map, const Surfaces& surfaces,
                          const Gripper& gripper, const DetectConfig& config) {
  const FarSides far_sides = find_far_sides(surfaces, depth_map);
  const CheckedScene scene{cloud, depth_map, surfaces, far_sides};
  CheckBuffersOfThreads buffers;
  Settler settler(gripper, config.check, buffers);
  SearchResult result;
  result.segments = start_reports(surfaces);
  const std::pmr::vector<std::uint8_t> all(surfaces.segments.list.size(), 1);
  const GuessSearch search(scene, surfaces.objects, gripper, config);
  search.run(all, buffers, result);
  std::optional<GuessSearch> of_wholes;
  const std::pmr::vector<std::uint8_t> left = segments_to_try(surfaces, result.handles);
  if (std::any_of(left.begin(), left.end(), [](std::uint8_t wanted) { return wanted != 0; })) {
    std::pmr::vector<FoundHandle> found = std::exchange(result.handles, {});
    of_wholes.emplace(scene, surfaces.wholes, gripper, config).run(left, buffers, result);
    add_for_parts_without(surfaces, std::exchange(result.handles, {}), settler, found);
    result.handles = std::move(found);
  }
  for (FoundHandle& first : first_handles(result.handles, surfaces, gripper, config.check, buffers)) {
    result.count(first.ranked.handle.segment, Failure::kNone);
    result.handles.push_back(std::move(first));
  }
  std::pmr::vector<RankedHandle> ranked;
  ranked.reserve(result.handles.size());
  for (const FoundHandle& found : result.handles) ranked.push_back(found.ranked);
  const auto settle = [&](const std::pmr::vector<std::size_t>& which,
                          std::pmr::vector<RankedHandle>& handles) {
    tbb::parallel_for(std::size_t{0}, which.size(), [&](std::size_t k) {
      handles[which[k]].handle.score = settler.final_score(result.handles[which[k]]);
    });
  };
  return {rank_handles(std::move(ranked), config.ranking, settle), std::move(result.segments),
          result.num_tried, result.failures};
}

}  // namespace graspd
