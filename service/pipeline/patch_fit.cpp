// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/patch_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory_resource>
#include <vector>

#include "service/pipeline/bin_set.hpp"
#include "service/pipeline/nth_value.hpp"

namespace graspd {
namespace {

constexpr float kBin = 0.001f;  // of the profile along the closing axis [m]
constexpr float kTopWindow =
    0.012f;  // around the candidate's position, where the top is looked for first [m]

/// Who is where along the closing axis.
struct Profile {
  BinSet own, any;  // bins with points of the object, and of anything
  BinSet others;

  /// n selected points leave their marks.
  Profile(const BandTags& tags, std::size_t n, CheckBuffers& buffers)
      : own(mark(tags, n, buffers).subspan(tags.stride(), tags.stride())),
        any(own),
        others(std::span(buffers.marked).first(tags.stride())) {
    any = own | others;
  }

 private:
  static std::span<const std::uint8_t> mark(const BandTags& tags, std::size_t n, CheckBuffers& buffers) {
    buffers.marked.assign(static_cast<std::size_t>(tags.no_mark()) + 1, 0);
    for (std::size_t i = 0; i < n; ++i)
      buffers.marked[static_cast<std::size_t>(buffers.marks[buffers.selected[i]])] = 1;
    return buffers.marked;
  }
};

/// The bin of the set that is nearest to one, the one after it where two are; -1 where none is within so many
/// bins.
int nearest(const BinSet& bins, int bin, int within) {
  const int after = bins.next(bin), before = bins.previous(bin);
  const int up = after < bins.size() ? after - bin : within, down = before >= 0 ? bin - before : within;
  if (std::min(up, down) >= within) return -1;
  return up <= down ? after : before;
}

/// Depth that only a few of the object's points between f_min and f_max are above.
bool find_top(CheckBuffers& buffers, float f_min, float f_max, float& top_m) {
  std::pmr::vector<float>& z = buffers.depths;
  const std::size_t n =
      point_kernels().keep_depths(buffers.local.band(), buffers.own.data(), f_min, f_max, z.data());
  if (n < 4) return false;
  const std::size_t skip = std::min(n / 4, std::max<std::size_t>(1, n / 50));
  top_m = nth_value({z.data(), n}, skip);
  return true;
}

/// How much less deep the fingertips must go so that they stay above the support and clear of what is below.
float raise_for_obstacles(const SceneView& scene, const Gripper& g, const HandleCheckConfig& config,
                          const Candidate& candidate, CheckBuffers& buffers, const PatchFit& fit) {
  const float half = 0.5f * std::min(g.aperture_m, fit.width_m + 2 * config.clearance_m);
  float raise = 0;
  if (scene.support) {
    const Plane& plane = scene.support->plane;
    const float steepness = -candidate.rotation.col(2).dot(plane.normal);
    if (steepness > 0.1f)
      for (const float a : {-0.5f, 0.5f})
        for (const float f : {-half - g.finger_width_m, half + g.finger_width_m}) {
          const Eigen::Vector3f tip(a * g.finger_thickness_m, fit.center_m + f, fit.top_m + g.grasp_depth_m);
          const float height = plane.height(candidate.position + candidate.rotation * tip);
          raise = std::max(raise, (config.support_clearance_m + 0.002f - height) / steepness);
        }
  }
  // Depths where something is in a finger's way.
  const float beside = std::nextafter(half, 1.0f);
  const std::size_t n = point_kernels().select_band({fit.center_m, fit.top_m, beside, half + g.finger_width_m,
                                                     g.grasp_depth_m - g.finger_length_m, g.grasp_depth_m},
                                                    buffers.local.band(), buffers.selected.data());
  const auto allowed = static_cast<std::size_t>(scene.tolerance / 2);
  if (n > allowed) {
    for (std::size_t i = 0; i < n; ++i) buffers.depths[i] = buffers.local.z[buffers.selected[i]] - fit.top_m;
    const float highest = nth_value({buffers.depths.data(), n}, allowed);
    raise = std::max(raise, g.grasp_depth_m - highest + 0.001f);
  }
  return raise;
}

/// How far the profile goes: so that a patch as wide as the aperture that begins in the middle shows its gap,
/// and among all points, where handles are made, the free space beside it.
float profile_reach(const SceneView& scene, const Gripper& g) {
  return (scene.is_sparse() ? 1.0f : 1.5f) * g.aperture_m + g.min_gap_m;
}

/// The patch around position f0: between the nearest gaps on both sides, at depths down to l below top.
Failure find_patch(const BandTags& tags, const Gripper& g, CheckBuffers& buffers, float f0, PatchFit& fit) {
  constexpr float kAnywhere = std::numeric_limits<float>::infinity();
  const std::size_t n = point_kernels().select_band(
      {0, fit.top_m, 0, kAnywhere, g.grasp_depth_m - g.finger_length_m, g.grasp_depth_m},
      buffers.local.band(), buffers.selected.data());
  const Profile profile(tags, n, buffers);
  const int start = nearest(profile.own, cell_index((f0 - tags.first) / kBin, 1),
                            static_cast<int>(0.5f * g.aperture_m / kBin));
  if (start < 0) return Failure::kTooFewPoints;
  // Outwards over occupied bins to the nearest gaps, and to what comes first beyond them.
  const int min_gap = static_cast<int>(g.min_gap_m / kBin);
  const BinSet gaps = profile.any.gaps(min_gap);
  const int gap_below = gaps.previous(start - min_gap);
  const int low = gap_below < 0 ? profile.any.next(0) : gap_below + min_gap,
            high = profile.any.previous(gaps.next(start) - 1);
  const int below = profile.any.previous(low - 1),
            beyond = std::min(profile.any.next(high + 1), tags.num_bins);
  fit.width_m = kBin * static_cast<float>(high - low + 1);
  fit.center_m = tags.first + kBin * static_cast<float>(low) + 0.5f * fit.width_m;
  fit.gap_m = {std::min(g.aperture_m, kBin * static_cast<float>(low - below - 1)),
               std::min(g.aperture_m, kBin * static_cast<float>(beyond - high - 1))};
  if (fit.width_m <= g.aperture_m + 0.004f) return Failure::kNone;
  return profile.others.count(low, high) > 3 ? Failure::kNoGap : Failure::kTooWide;
}

/// The top of the whole patch may be higher than where the search began; then the depths below it are others,
/// and the patch too. gather(z): the points around depth z.
template <class Gather>
Failure settle_top(const BandTags& tags, const Gripper& g, CheckBuffers& buffers, const Gather& gather,
                   PatchFit& fit) {
  constexpr int kMostRounds = 4;
  float gathered_m = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    // What was gathered may end short of a top so far up, or of what is in the fingers' way above it.
    const bool is_far_up = fit.top_m < gathered_m - kTopWindow;
    if (is_far_up) gather(gathered_m = fit.top_m);
    const float before = fit.top_m;
    const float low = fit.center_m - 0.5f * fit.width_m, high = low + fit.width_m;
    if (!find_top(buffers, low, high, fit.top_m)) return Failure::kTooFewPoints;
    if (!is_far_up && std::abs(fit.top_m - before) < kBin) break;
    if (const Failure failure = find_patch(tags, g, buffers, fit.center_m, fit); failure != Failure::kNone)
      return failure;
  }
  return Failure::kNone;
}

void shift(LocalPoints& local, float f, float z) {
  for (std::size_t k = 0; k < local.size(); ++k) {
    local.f[k] -= f;
    local.z[k] -= z;
  }
}

BandTags band_tags(const SceneView& scene, const Candidate& candidate, float reach_m) {
  // Where the support is in the way, the fingers go less deep: it does not widen the patch.
  return {scene.object_of_voxel.data(),
          scene.voxel.data(),
          candidate.object,
          kSupportObject,
          -reach_m,
          kBin,
          std::min(static_cast<int>(2 * reach_m / kBin) + 1, BinSet::kMostBins)};
}

/// Whose the points are, and where in the profile.
void describe_points(const BandTags& tags, CheckBuffers& buffers) {
  const LocalPoints& local = buffers.local;
  if (const std::size_t room = local.size() + kPointPadding; buffers.own.size() < room) {
    buffers.own.resize(2 * room);
    buffers.marks.resize(2 * room);
    buffers.depths.resize(2 * room);
    buffers.widths.resize(2 * room);
    buffers.selected.resize(2 * room);
  }
  point_kernels().tag_band(tags, buffers.local.band(), buffers.own.data(), buffers.marks.data());
}

}  // namespace

Failure fit_patch(const SceneView& scene, const Gripper& gripper, const HandleCheckConfig& config,
                  const Candidate& candidate, CheckBuffers& buffers, PatchFit& fit) {
  const Gripper& g = gripper;
  const float reach = profile_reach(scene, g);
  const BandTags tags = band_tags(scene, candidate, reach);
  // As far up as the fingers reach when they go in the least deep.
  const float above = g.finger_length_m - config.min_grip_depth_m + kTopWindow;
  const auto gather = [&](float z) {
    scene.query.find(
        candidate.position, candidate.rotation, {-0.5f * g.finger_thickness_m, -reach, z - above},
        {0.5f * g.finger_thickness_m, reach, z + g.grasp_depth_m + 2 * kTopWindow}, buffers.local);
    describe_points(tags, buffers);
  };
  gather(0);
  if (!find_top(buffers, -kTopWindow, kTopWindow, fit.top_m)) return Failure::kTooFewPoints;
  if (const Failure failure = find_patch(tags, g, buffers, 0, fit); failure != Failure::kNone) return failure;
  if (const Failure failure = settle_top(tags, g, buffers, gather, fit); failure != Failure::kNone)
    return failure;
  const float raise = raise_for_obstacles(scene, g, config, candidate, buffers, fit);
  if (raise > g.grasp_depth_m - config.min_grip_depth_m) return Failure::kFingers;
  fit.top_m -= raise;
  shift(buffers.local, fit.center_m, fit.top_m);
  return Failure::kNone;
}

}  // namespace graspd
