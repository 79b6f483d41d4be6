// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/find_handles.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "service/pipeline/object_outline.hpp"

namespace graspd {
namespace {

constexpr float kVoxelCell = 0.03f;  // of the grids for box queries [m]
constexpr float kPointCell = 0.015f;
constexpr int kVoxelTolerance =
    2;  // stray points a volume may have: counts are absolute, noise does not scale
constexpr int kPointTolerance = 4;

using Results = std::vector<CheckResult>;

/// outlines: to refuse at little cost what is much too wide; may be null.
Results check_all(const SceneView& scene, const Gripper& gripper, const HandleCheckConfig& config,
                  const std::vector<Candidate>& candidates, const ObjectOutlines* outlines) {
  Results results(candidates.size());
  tbb::enumerable_thread_specific<CheckBuffers> buffers;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size(), 8), [&](const auto& range) {
    CheckBuffers& own = buffers.local();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Candidate& candidate = candidates[i];
      if (outlines && outlines->clearly_too_wide(candidate, gripper))
        results[i].failure = Failure::kTooWide;
      else
        results[i] = check_candidate(scene, gripper, config, candidate, own);
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
Handle scored(const CheckResult& result, const Eigen::Vector3f& center) {
  constexpr float kFalloff = 0.06f;
  HandleMargins margins = result.margins;
  const float off = result.handle.rotation.col(0).dot(center - result.handle.position) / kFalloff;
  margins.central = std::exp(-off * off);
  Handle handle = result.handle;
  handle.score = score(margins);
  return handle;
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

/// The candidates that pass among the voxels; counts the others.
std::vector<Candidate> prefilter(const SceneView& voxels, const Gripper& gripper,
                                 const HandleCheckConfig& config, const std::vector<Candidate>& candidates,
                                 const ObjectOutlines& outlines, CheckedCandidates& out) {
  const Results coarse = check_all(voxels, gripper, config, candidates, &outlines);
  std::vector<Candidate> left;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (coarse[i].failure == Failure::kNone)
      left.push_back(candidates[i]);
    else
      count(candidates[i], coarse[i].failure, out);
  }
  return left;
}

/// An object with this many handles takes no part in a round.
int enough_before(SearchRound round) {
  switch (round) {
    case SearchRound::kSurface:
      return std::numeric_limits<int>::max();
    case SearchRound::kSurroundings:
      return 8;
    case SearchRound::kAllDirections:
      return 1;
  }
  return 0;
}

}  // namespace

CheckedCandidates find_handles(const PointCloud& cloud, const Surfaces& surfaces, const Gripper& gripper,
                               const DetectConfig& config) {
  const DepthMap depth_map(cloud);
  const std::vector<std::int32_t> object_of_point =
      spread_to_points(surfaces.objects.of_point, surfaces.voxel_of_point);
  const BoxQuery voxel_query(surfaces.cloud, kVoxelCell), point_query(cloud, kPointCell);
  const ObjectOutlines outlines(surfaces.cloud, surfaces.objects.of_point, surfaces.objects.num_objects);
  const float area = config.downsample.leaf_size_m * config.downsample.leaf_size_m;
  const SceneView voxels{surfaces.cloud,   voxel_query,     surfaces.objects.of_point,
                         surfaces.normals, nullptr,         surfaces.support,
                         depth_map,        object_of_point, area,
                         kVoxelTolerance};
  const SceneView points{cloud,
                         point_query,
                         object_of_point,
                         surfaces.normals,
                         &surfaces.voxel_of_point,
                         surfaces.support,
                         depth_map,
                         object_of_point,
                         area,
                         kPointTolerance};
  const SearchInput input = surfaces.search_input();
  const HandleSearch search(input, gripper, config.search);
  CheckedCandidates out;
  out.segments = start_reports(surfaces);
  std::vector<int> handles_of_object(static_cast<std::size_t>(surfaces.objects.num_objects));
  for (const SearchRound round : kSearchRounds) {
    std::vector<std::uint8_t> wanted(handles_of_object.size());
    for (std::size_t k = 0; k < wanted.size(); ++k)
      wanted[k] = handles_of_object[k] < enough_before(round) ? 1 : 0;
    const std::vector<Candidate> candidates = search.candidates(round, wanted);
    const std::vector<Candidate> left = prefilter(voxels, gripper, config.check, candidates, outlines, out);
    const Results fine = check_all(points, gripper, config.check, left, nullptr);
    for (std::size_t k = 0; k < left.size(); ++k) {
      count(left[k], fine[k].failure, out);
      if (fine[k].failure != Failure::kNone) continue;
      const auto object = static_cast<std::size_t>(left[k].object);
      out.handles.push_back({scored(fine[k], surfaces.objects.center[object]), left[k].object});
      ++handles_of_object[object];
    }
  }
  return out;
}

}  // namespace graspd
