// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/patch_fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace graspd {
namespace {

constexpr float kBin = 0.001f;  // of the profile along the closing axis [m]
constexpr float kTopWindow =
    0.012f;  // around the candidate's position, where the top is looked for first [m]

/// Bin of the profile that begins at first_m; may be outside it.
int bin_of(float f, float first_m) {
  return cell_index((f - first_m) / kBin, 1);
}

/// Occupancy along the closing axis.
struct Profile {
  float first_m;  ///< of bin 0
  std::vector<int>&own, &all;

  Profile(float half_length, CheckBuffers& buffers)
      : first_m(-half_length), own(buffers.own_profile), all(buffers.all_profile) {
    const auto bins = static_cast<std::size_t>(num_bins(half_length));
    own.assign(bins, 0);
    all.assign(bins, 0);
  }
  [[nodiscard]] static int num_bins(float half_length) {
    return static_cast<int>(2 * half_length / kBin) + 1;
  }
  [[nodiscard]] float at(int bin) const { return first_m + kBin * static_cast<float>(bin); }
  [[nodiscard]] int size() const { return static_cast<int>(all.size()); }
};

/// Walks outwards from a bin over occupied bins; stops before the first gap of min_gap bins. Returns the last
/// occupied bin, and in next the first occupied one beyond the gap (or the end of the profile).
int walk(const Profile& profile, int from, int step, int min_gap, int& next) {
  int last = from;
  for (int b = from; b >= 0 && b < profile.size(); b += step) {
    if (profile.all[static_cast<std::size_t>(b)] == 0) continue;
    if (std::abs(b - last) > min_gap) {
      next = b;
      return last;
    }
    last = b;
  }
  next = step < 0 ? -1 : profile.size();
  return last;
}

BandPoints band(const CheckBuffers& buffers) {
  const LocalPoints& local = buffers.local;
  return {local.f.data(), local.z.data(), local.index.data(), local.size()};
}

/// Depth that only a few of the object's points between f_min and f_max are above.
bool find_top(CheckBuffers& buffers, float f_min, float f_max, float& top_m) {
  std::vector<float>& z = buffers.depths;
  const std::size_t n =
      point_kernels().keep_depths(band(buffers), buffers.own.data(), f_min, f_max, z.data());
  if (n < 4) return false;
  const std::size_t skip = std::min(n / 4, std::max<std::size_t>(1, n / 50));
  const auto begin = z.begin(), nth = begin + static_cast<std::ptrdiff_t>(skip);
  std::nth_element(begin, nth, begin + static_cast<std::ptrdiff_t>(n));
  top_m = *nth;
  return true;
}

/// How much less deep the fingertips must go so that they stay above the support and clear of what is below.
float raise_for_obstacles(const SceneView& scene, const Gripper& g, const HandleCheckConfig& config,
                          const Candidate& candidate, CheckBuffers& buffers, const PatchFit& fit) {
  const LocalPoints& local = buffers.local;
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
  std::vector<float>& hits =
      buffers.depths;  // above the fingertips' depth, where something is in a finger's way
  std::size_t n = 0;
  for (std::size_t k = 0; k < local.size(); ++k) {
    const float f = std::abs(local.f[k] - fit.center_m), z = local.z[k] - fit.top_m;
    hits[n] = g.grasp_depth_m - z;
    n += static_cast<std::size_t>(int{f > half} & int{f <= half + g.finger_width_m} &
                                  int{z <= g.grasp_depth_m} & int{z >= g.grasp_depth_m - g.finger_length_m});
  }
  const auto allowed = static_cast<std::size_t>(scene.tolerance / 2);
  if (n > allowed) {
    const auto nth = hits.begin() + static_cast<std::ptrdiff_t>(allowed);
    std::nth_element(hits.begin(), nth, hits.begin() + static_cast<std::ptrdiff_t>(n), std::greater<>());
    raise = std::max(raise, *nth + 0.001f);
  }
  return raise;
}

/// How far the profile goes: so that a patch as wide as the aperture that begins in the middle shows its gap,
/// and among all points, where handles are made, the free space beside it.
float profile_reach(const SceneView& scene, const Gripper& g) {
  return (scene.voxel ? 1.5f : 1.0f) * g.aperture_m + g.min_gap_m;
}

/// The patch around position f0: between the nearest gaps on both sides, at depths down to l below top.
Failure find_patch(const SceneView& scene, const Gripper& g, CheckBuffers& buffers, float f0, PatchFit& fit) {
  const LocalPoints& local = buffers.local;
  Profile profile(profile_reach(scene, g), buffers);
  for (std::size_t k = 0; k < local.size(); ++k) {
    const float z = local.z[k] - fit.top_m;
    const int b = buffers.bins[k];
    if (b < 0 || z > g.grasp_depth_m || z < g.grasp_depth_m - g.finger_length_m) continue;
    ++profile.all[static_cast<std::size_t>(b)];
    profile.own[static_cast<std::size_t>(b)] += buffers.own[k];
  }
  int start = bin_of(f0, profile.first_m);
  for (int d = 0; d < static_cast<int>(0.5f * g.aperture_m / kBin); ++d) {
    const auto own_at = [&](int b) {
      return b >= 0 && b < profile.size() && profile.own[static_cast<std::size_t>(b)] > 0;
    };
    if (own_at(start + d)) {
      start += d;
      break;
    }
    if (own_at(start - d)) {
      start -= d;
      break;
    }
  }
  if (start < 0 || start >= profile.size() || profile.own[static_cast<std::size_t>(start)] == 0)
    return Failure::kTooFewPoints;
  const int min_gap = static_cast<int>(g.min_gap_m / kBin);
  int below = 0, beyond = 0;
  const int low = walk(profile, start, -1, min_gap, below), high = walk(profile, start, 1, min_gap, beyond);
  fit.width_m = kBin * static_cast<float>(high - low + 1);
  fit.center_m = profile.at(low) + 0.5f * fit.width_m;
  fit.gap_m = {std::min(g.aperture_m, kBin * static_cast<float>(low - below - 1)),
               std::min(g.aperture_m, kBin * static_cast<float>(beyond - high - 1))};
  if (fit.width_m <= g.aperture_m + 0.004f) return Failure::kNone;
  int other = 0;
  for (int b = low; b <= high; ++b)
    other += profile.all[static_cast<std::size_t>(b)] > profile.own[static_cast<std::size_t>(b)] ? 1 : 0;
  return other > 3 ? Failure::kNoGap : Failure::kTooWide;
}

/// The top of the whole patch may be higher than where the search began; then the depths below it are others,
/// and the patch too. gather(z): the points around depth z.
template <class Gather>
Failure settle_top(const SceneView& scene, const Gripper& g, CheckBuffers& buffers, const Gather& gather,
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
    if (const Failure failure = find_patch(scene, g, buffers, fit.center_m, fit); failure != Failure::kNone)
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

/// Whose the points are, and where in the profile.
void describe_points(const SceneView& scene, const Candidate& candidate, float reach_m,
                     CheckBuffers& buffers) {
  const LocalPoints& local = buffers.local;
  if (const std::size_t room = local.size() + kPointPadding; buffers.own.size() < room) {
    buffers.own.resize(2 * room);
    buffers.bins.resize(2 * room);
    buffers.depths.resize(2 * room);
    buffers.widths.resize(2 * room);
  }
  // Where the support is in the way, the fingers go less deep: it does not widen the patch.
  const BandTags tags{scene.object.data(),       candidate.object, kSupportObject, -reach_m, kBin,
                      Profile::num_bins(reach_m)};
  point_kernels().tag_band(tags, band(buffers), buffers.own.data(), buffers.bins.data());
}

}  // namespace

Failure fit_patch(const SceneView& scene, const Gripper& gripper, const HandleCheckConfig& config,
                  const Candidate& candidate, CheckBuffers& buffers, PatchFit& fit) {
  const Gripper& g = gripper;
  const float reach = profile_reach(scene, g);
  // As far up as the fingers reach when they go in the least deep.
  const float above = g.finger_length_m - config.min_grip_depth_m + kTopWindow;
  const auto gather = [&](float z) {
    scene.query.find(
        candidate.position, candidate.rotation, {-0.5f * g.finger_thickness_m, -reach, z - above},
        {0.5f * g.finger_thickness_m, reach, z + g.grasp_depth_m + 2 * kTopWindow}, buffers.local);
    describe_points(scene, candidate, reach, buffers);
  };
  gather(0);
  if (!find_top(buffers, -kTopWindow, kTopWindow, fit.top_m)) return Failure::kTooFewPoints;
  if (const Failure failure = find_patch(scene, g, buffers, 0, fit); failure != Failure::kNone)
    return failure;
  if (const Failure failure = settle_top(scene, g, buffers, gather, fit); failure != Failure::kNone)
    return failure;
  const float raise = raise_for_obstacles(scene, g, config, candidate, buffers, fit);
  if (raise > g.grasp_depth_m - config.min_grip_depth_m) return Failure::kFingers;
  fit.top_m -= raise;
  shift(buffers.local, fit.center_m, fit.top_m);
  return Failure::kNone;
}

}  // namespace graspd
