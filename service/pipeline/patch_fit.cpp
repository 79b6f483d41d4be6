// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/patch_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "service/pipeline/nth_value.hpp"

namespace graspd {
namespace {

constexpr float kBin = 0.001f;  // of the profile along the closing axis [m]
constexpr float kTopWindow =
    0.012f;  // around the candidate's position, where the top is looked for first [m]

/// Who is where along the closing axis.
class Profile {
 public:
  /// tags: whose bins these are. n selected points leave their marks.
  Profile(const BandTags& tags, std::size_t n, CheckBuffers& buffers)
      : first_m_(tags.first), size_(tags.num_bins), marked_(buffers.marked) {
    marked_.assign(static_cast<std::size_t>(tags.no_mark()) + 1, 0);
    for (std::size_t i = 0; i < n; ++i)
      marked_[static_cast<std::size_t>(buffers.marks[buffers.selected[i]])] = 1;
  }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] bool has_bin(int bin) const { return bin >= 0 && bin < size_; }
  /// Of a bin that there is.
  [[nodiscard]] bool has_other(int bin) const { return marked_[static_cast<std::size_t>(2 * bin)] != 0; }
  [[nodiscard]] bool has_own(int bin) const { return marked_[static_cast<std::size_t>(2 * bin + 1)] != 0; }
  [[nodiscard]] bool has_any(int bin) const { return has_other(bin) || has_own(bin); }
  /// Where a bin begins [m].
  [[nodiscard]] float at(int bin) const { return first_m_ + kBin * static_cast<float>(bin); }
  [[nodiscard]] int bin_of(float f) const { return cell_index((f - first_m_) / kBin, 1); }

 private:
  float first_m_;
  int size_;
  std::vector<std::uint8_t>& marked_;
};

/// Walks outwards from a bin over occupied bins; stops before the first gap of min_gap bins. Returns the last
/// occupied bin, and in next the first occupied one beyond the gap (or the end of the profile).
int walk(const Profile& profile, int from, int step, int min_gap, int& next) {
  int last = from;
  for (int b = from; profile.has_bin(b); b += step) {
    if (!profile.has_any(b)) continue;
    if (std::abs(b - last) > min_gap) {
      next = b;
      return last;
    }
    last = b;
  }
  next = step < 0 ? -1 : profile.size();
  return last;
}

/// Depth that only a few of the object's points between f_min and f_max are above.
bool find_top(CheckBuffers& buffers, float f_min, float f_max, float& top_m) {
  std::vector<float>& z = buffers.depths;
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
  return (scene.voxel ? 1.5f : 1.0f) * g.aperture_m + g.min_gap_m;
}

/// The patch around position f0: between the nearest gaps on both sides, at depths down to l below top.
Failure find_patch(const BandTags& tags, const Gripper& g, CheckBuffers& buffers, float f0, PatchFit& fit) {
  constexpr float kAnywhere = std::numeric_limits<float>::infinity();
  const std::size_t n = point_kernels().select_band(
      {0, fit.top_m, 0, kAnywhere, g.grasp_depth_m - g.finger_length_m, g.grasp_depth_m},
      buffers.local.band(), buffers.selected.data());
  const Profile profile(tags, n, buffers);
  const auto is_own = [&profile](int b) { return profile.has_bin(b) && profile.has_own(b); };
  int start = profile.bin_of(f0);
  for (int d = 0; d < static_cast<int>(0.5f * g.aperture_m / kBin); ++d) {
    if (is_own(start + d)) {
      start += d;
      break;
    }
    if (is_own(start - d)) {
      start -= d;
      break;
    }
  }
  if (!is_own(start)) return Failure::kTooFewPoints;
  const int min_gap = static_cast<int>(g.min_gap_m / kBin);
  int below = 0, beyond = 0;
  const int low = walk(profile, start, -1, min_gap, below), high = walk(profile, start, 1, min_gap, beyond);
  fit.width_m = kBin * static_cast<float>(high - low + 1);
  fit.center_m = profile.at(low) + 0.5f * fit.width_m;
  fit.gap_m = {std::min(g.aperture_m, kBin * static_cast<float>(low - below - 1)),
               std::min(g.aperture_m, kBin * static_cast<float>(beyond - high - 1))};
  if (fit.width_m <= g.aperture_m + 0.004f) return Failure::kNone;
  int other = 0;
  for (int b = low; b <= high; ++b) other += profile.has_other(b) ? 1 : 0;
  return other > 3 ? Failure::kNoGap : Failure::kTooWide;
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
  return {scene.object.data(),
          candidate.object,
          kSupportObject,
          -reach_m,
          kBin,
          static_cast<int>(2 * reach_m / kBin) + 1};
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
