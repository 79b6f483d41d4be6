// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/candidate_checks.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace graspd {
namespace {

constexpr float kGridCell = 0.02f;   // of the box queries [m]
constexpr int kVoxelTolerance = 2;   // stray points a volume may have: counts are absolute, noise does not scale
constexpr int kPointTolerance = 4;

using Results = std::vector<CheckResult>;

Results check_all(const SceneView& scene, const Gripper& gripper, const HandleCheckConfig& config,
                  const std::vector<Candidate>& candidates) {
  Results results(candidates.size());
  tbb::enumerable_thread_specific<CheckBuffers> buffers;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size(), 8), [&](const auto& range) {
    CheckBuffers& own = buffers.local();
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      results[i] = check_candidate(scene, gripper, config, candidates[i], own);
  });
  return results;
}

std::vector<std::int32_t> spread_to_points(const std::vector<std::int32_t>& of_voxel,
                                           const std::vector<std::uint32_t>& voxel_of_point) {
  std::vector<std::int32_t> of_point(voxel_of_point.size());
  for (std::size_t i = 0; i < of_point.size(); ++i) of_point[i] = of_voxel[voxel_of_point[i]];
  return of_point;
}

void count_failures(const std::vector<Candidate>& candidates, const std::vector<Failure>& failures,
                    std::size_t num_segments, CheckedCandidates& out) {
  std::vector<Failure> farthest(num_segments, Failure::kTooFewPoints);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (failures[i] != Failure::kNone) ++out.candidate_failures[static_cast<std::size_t>(failures[i])];
    Failure& f = farthest[static_cast<std::size_t>(candidates[i].segment)];
    f = std::max(f, failures[i]);
  }
  for (const Failure f : farthest)
    if (f != Failure::kNone) ++out.segment_failures[static_cast<std::size_t>(f)];
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

  const Results coarse = check_all(voxels, gripper, config.check, candidates);
  std::vector<Failure> failures(candidates.size());
  std::vector<Candidate> left;
  std::vector<std::size_t> left_index;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    failures[i] = coarse[i].failure;
    if (coarse[i].failure != Failure::kNone) continue;
    left.push_back(candidates[i]);
    left_index.push_back(i);
  }
  CheckedCandidates out;
  const Results fine = check_all(points, gripper, config.check, left);
  for (std::size_t k = 0; k < fine.size(); ++k) {
    failures[left_index[k]] = fine[k].failure;
    if (fine[k].failure == Failure::kNone) out.handles.push_back({fine[k].handle, left[k].object});
  }
  count_failures(candidates, failures, surfaces.segments.list.size(), out);
  return out;
}

}  // namespace graspd
