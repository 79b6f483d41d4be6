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

constexpr float kBelowTips = 0.005f;  // how far the checks look [m]
constexpr float kLower = 0.007f;      // than the place looked at a top may be [m]
constexpr float kBin = 0.001f;        // of the profile along the closing axis [m]
constexpr float kTopWindow =
    0.012f;  // around the candidate's position, where the top is looked for first [m]

/// Who is where along the closing axis.
struct Profile {
  BinSet own, any;  // bins with points of the object, and of anything
  BinSet others;

  /// The points within the limits leave their marks.
  Profile(const BandTags& tags, const BandLimits& limits, CheckBuffers& buffers)
      : own(mark(tags, limits, buffers).subspan(tags.stride(), tags.stride())),
        any(own),
        others(std::span(buffers.marked).first(tags.stride())) {
    any = own | others;
  }

 private:
  static std::span<const std::uint8_t> mark(const BandTags& tags, const BandLimits& limits,
                                            CheckBuffers& buffers) {
    buffers.marked.assign(static_cast<std::size_t>(tags.no_mark()) + 1, 0);
    point_kernels().mark_band(limits, buffers.local.band(), buffers.marks.data(), buffers.marked.data());
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

/// Depth that only a few of the object's points of a part are above.
bool find_top(CheckBuffers& buffers, const BandPart& part, float& top_m) {
  std::pmr::vector<float>& z = buffers.depths;
  const std::size_t n = point_kernels().keep_depths(buffers.local.band(), buffers.own.data(), part, z.data());
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
  if (const Plane* const plane = scene.plane_under(candidate.object); plane != nullptr) {
    const float steepness = -candidate.rotation.col(2).dot(plane->normal);
    if (steepness > 0.1f)
      for (const float a : {-0.5f, 0.5f})
        for (const float f : {-half - g.finger_width_m, half + g.finger_width_m}) {
          const Eigen::Vector3f tip(a * g.finger_thickness_m, fit.center_m + f, fit.top_m + g.grasp_depth_m);
          const float height = plane->height(candidate.position + candidate.rotation * tip);
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

/// Bins from one gap to the next.
struct Stretch {
  int low, high;
  [[nodiscard]] float width_m() const { return kBin * static_cast<float>(high - low + 1); }
};

/// Outwards from an occupied bin over bins to the nearest gaps.
Stretch between_gaps(const BinSet& bins, int start, int min_gap) {
  const BinSet gaps = bins.gaps(min_gap);
  const int gap_below = gaps.previous(start - min_gap);
  return {gap_below < 0 ? bins.next(0) : gap_below + min_gap, bins.previous(gaps.next(start) - 1)};
}

/// Whether too few of the points within the limits are the object's.
bool is_shared(const HandleCheckConfig& config, CheckBuffers& buffers, const BandLimits& limits) {
  const BandCounts n =
      point_kernels().select_own(limits, buffers.local.band(), buffers.own.data(), buffers.selected.data());
  return static_cast<float>(n.own) < config.min_own_share * static_cast<float>(n.all);
}

/// For a patch at depths down to depth_m below its top.
struct PatchSearch {
  const BandTags& tags;
  const Gripper& g;
  const HandleCheckConfig& config;
  float depth_m;
};

/// The patch around position f0: between the nearest gaps on both sides, at the depths searched.
/// Where others are so near that it is shared with them (kNoGap), between the nearest gaps of the object.
Failure find_patch(const PatchSearch& search, CheckBuffers& buffers, float f0, PatchFit& fit) {
  const BandTags& tags = search.tags;
  const Gripper& g = search.g;
  constexpr float kAnywhere = std::numeric_limits<float>::infinity();
  constexpr int kStray = 3;  // bins
  BandLimits limits{0, fit.top_m, 0, kAnywhere, g.grasp_depth_m - g.finger_length_m, search.depth_m};
  const Profile profile(tags, limits, buffers);
  const int start = nearest(profile.own, cell_index((f0 - tags.first) / kBin, 1),
                            static_cast<int>(0.5f * g.aperture_m / kBin));
  if (start < 0) return Failure::kTooFewPoints;
  const int min_gap = static_cast<int>(g.min_gap_m / kBin);
  const auto take = [&](const Stretch& patch) {
    const int below = profile.any.previous(patch.low - 1),
              beyond = std::min(profile.any.next(patch.high + 1), tags.num_bins);
    fit.width_m = patch.width_m();
    fit.center_m = tags.first + kBin * static_cast<float>(patch.low) + 0.5f * fit.width_m;
    fit.gap_m = {std::min(g.aperture_m, kBin * static_cast<float>(patch.low - below - 1)),
                 std::min(g.aperture_m, kBin * static_cast<float>(beyond - patch.high - 1))};
  };
  const Stretch patch = between_gaps(profile.any, start, min_gap);
  take(patch);
  const bool is_wide = fit.width_m > g.aperture_m + 0.004f;
  if (profile.others.count(patch.low, patch.high) <= kStray)
    return is_wide ? Failure::kTooWide : Failure::kNone;
  limits.middle = fit.center_m;
  limits.max_distance = 0.5f * fit.width_m;
  if (!is_wide && !is_shared(search.config, buffers, limits)) return Failure::kNone;
  take(between_gaps(profile.own, start, min_gap));
  return Failure::kNoGap;
}

/// The top of the whole patch may be higher than where the search began; then the depths below it are others,
/// and the patch too. look_at(z): the points around depth z; returns from which depth on.
template <class LookAt>
Failure settle_top(const PatchSearch& search, CheckBuffers& buffers, const LookAt& look_at, PatchFit& fit) {
  constexpr int kMostRounds = 4;
  float looked_at_m = 0, z_min = look_at(0);
  for (int round = 0; round < kMostRounds; ++round) {
    // What was looked at may end short of a top so far up, or of what is in the fingers' way above it.
    const bool is_elsewhere = fit.top_m < looked_at_m - kTopWindow || fit.top_m > looked_at_m + kLower;
    if (is_elsewhere) z_min = look_at(looked_at_m = fit.top_m);
    const float before = fit.top_m;
    const float low = fit.center_m - 0.5f * fit.width_m, high = low + fit.width_m;
    if (!find_top(buffers, {low, high, z_min}, fit.top_m)) return Failure::kTooFewPoints;
    if (!is_elsewhere && std::abs(fit.top_m - before) < kBin) break;
    if (const Failure failure = find_patch(search, buffers, fit.center_m, fit); failure != Failure::kNone)
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
  return {scene.object_of_voxel.data(),
          scene.voxel.data(),
          candidate.object,
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

float least_grip_depth(const Plane* support, const HandleCheckConfig& config, const Eigen::Vector3f& top,
                       const Eigen::Vector3f& approach) {
  constexpr float kSteep = 0.5f;     // cosine between approach and support's normal
  constexpr float kLowest = 0.010f;  // of what counts as a thing on the support [m]
  if (support == nullptr) return config.min_grip_depth_m;
  const float steepness = -approach.dot(support->normal);
  if (steepness < kSteep) return config.min_grip_depth_m;
  const float height = std::max(kLowest, support->height(top));
  return std::min(config.min_grip_depth_m, config.min_grip_share * height / steepness);
}

Failure fit_patch(const SceneView& scene, const Gripper& gripper, const HandleCheckConfig& config,
                  const Candidate& candidate, CheckBuffers& buffers, PatchFit& fit) {
  const Gripper& g = gripper;
  const float reach = profile_reach(scene, g);
  const BandTags tags = band_tags(scene, candidate, reach);
  const Plane* const support = scene.plane_under(candidate.object);
  // As far up as the fingers reach when they go in the least deep; and further, as most tops are there.
  const auto least_depth = [&](float top_m) {
    const Eigen::Vector3f approach = candidate.rotation.col(2);
    return least_grip_depth(support, config, candidate.position + top_m * approach, approach);
  };
  const float above = g.finger_length_m - least_depth(0) + kTopWindow, further = g.finger_length_m;
  const float below = g.grasp_depth_m + kBelowTips + kLower;
  float gathered_m = std::numeric_limits<float>::infinity();
  const auto look_at = [&](float z) {
    if (!(z <= gathered_m && z >= gathered_m - further)) {
      gathered_m = z;
      scene.find(candidate.position, candidate.rotation,
                 {-0.5f * g.finger_thickness_m, -reach, z - above - further},
                 {0.5f * g.finger_thickness_m, reach, z + below}, buffers.local);
      describe_points(tags, buffers);
    }
    return z - above;
  };
  if (!find_top(buffers, {-kTopWindow, kTopWindow, look_at(0)}, fit.top_m)) return Failure::kTooFewPoints;
  if (fit.top_m > kLower) look_at(fit.top_m);
  const auto fit_to = [&](float depth_m) {
    const PatchSearch search{tags, g, config, depth_m};
    const Failure failure = find_patch(search, buffers, 0, fit);
    return failure != Failure::kNone ? failure : settle_top(search, buffers, look_at, fit);
  };
  // What the fingertips may be less deep by.
  float room = g.grasp_depth_m - least_depth(fit.top_m);
  float raise = std::min(room, std::max(0.0f, g.grasp_depth_m - candidate.depth_m));
  Failure failure = fit_to(g.grasp_depth_m - raise);
  if (failure == Failure::kNoGap && fit.width_m <= g.aperture_m) {
    // Above what leaves no gap at full depth there may be one.
    raise = std::max(raise, raise_for_obstacles(scene, g, config, candidate, buffers, fit));
    if (raise > room) return failure;
    failure = fit_to(g.grasp_depth_m - raise);
  }
  if (failure != Failure::kNone) return failure;
  room = g.grasp_depth_m - least_depth(fit.top_m) - raise;
  fit.top_m -= raise;
  raise = raise_for_obstacles(scene, g, config, candidate, buffers, fit);
  if (raise > room) return Failure::kFingers;
  fit.top_m -= raise;
  shift(buffers.local, fit.center_m, fit.top_m);
  return Failure::kNone;
}

}  // namespace graspd
