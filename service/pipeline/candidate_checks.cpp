// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/candidate_checks.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "service/pipeline/object_outline.hpp"

namespace graspd {
namespace {

constexpr float kGridCell = 0.01f;   // of the box queries [m]
constexpr int kVoxelTolerance = 2;   // stray points a volume may have: counts are absolute, noise does not scale
constexpr int kPointTolerance = 4;
constexpr int kRounds = 2;
constexpr int kEnoughHandles = 8;    // of an object: no further round for it

using Results = std::vector<CheckResult>;

/// outlines: to refuse at little cost what is much too wide; may be null.
Results check_all(const SceneView& scene, const Gripper& gripper, const HandleCheckConfig& config,
                  const std::vector<Candidate>& candidates, const std::vector<std::size_t>& which,
                  const ObjectOutlines* outlines) {
  Results results(which.size());
  tbb::enumerable_thread_specific<CheckBuffers> buffers;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, which.size(), 8), [&](const auto& range) {
    CheckBuffers& own = buffers.local();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Candidate& candidate = candidates[which[i]];
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

}  // namespace

CheckedCandidates check_candidates(const PointCloud& cloud, const Surfaces& surfaces,
                                   const std::vector<Candidate>& candidates, const Gripper& gripper,
                                   const DetectConfig& config) {
  const DepthMap depth_map(cloud);
  const std::vector<std::int32_t> object_of_point = spread_to_points(surfaces.objects.of_point, surfaces.voxel_of_point);
  const BoxQuery voxel_query(surfaces.cloud, kGridCell), point_query(cloud, kGridCell);
  const float leaf = config.downsample.leaf_size_m;
  const SceneView voxels{surfaces.cloud, voxel_query, surfaces.objects.of_point, surfaces.normals, nullptr,
                         surfaces.support, depth_map, object_of_point, leaf * leaf, kVoxelTolerance};
  const SceneView points{cloud, point_query, object_of_point, surfaces.normals, &surfaces.voxel_of_point,
                         surfaces.support, depth_map, object_of_point, leaf * leaf, kPointTolerance};

  const ObjectOutlines outlines(surfaces.cloud, surfaces.objects.of_point, surfaces.objects.num_objects);
  CheckedCandidates out;
  out.segments = start_reports(surfaces);
  std::vector<int> handles_of_object(static_cast<std::size_t>(surfaces.objects.num_objects));
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::size_t> tried, left;
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (candidates[i].round == round &&
          handles_of_object[static_cast<std::size_t>(candidates[i].object)] < kEnoughHandles)
        tried.push_back(i);
    const Results coarse = check_all(voxels, gripper, config.check, candidates, tried, &outlines);
    for (std::size_t k = 0; k < tried.size(); ++k) {
      if (coarse[k].failure == Failure::kNone)
        left.push_back(tried[k]);
      else
        count(candidates[tried[k]], coarse[k].failure, out);
    }
    const Results fine = check_all(points, gripper, config.check, candidates, left, nullptr);
    for (std::size_t k = 0; k < left.size(); ++k) {
      const Candidate& candidate = candidates[left[k]];
      count(candidate, fine[k].failure, out);
      if (fine[k].failure != Failure::kNone) continue;
      const auto object = static_cast<std::size_t>(candidate.object);
      out.handles.push_back({scored(fine[k], surfaces.objects.center[object]), candidate.object});
      ++handles_of_object[object];
    }
  }
  return out;
}

}  // namespace graspd
