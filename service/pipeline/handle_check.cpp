// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/handle_check.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <utility>

#include "service/pipeline/contact.hpp"
#include "service/pipeline/nth_value.hpp"
#include "service/pipeline/one_face.hpp"
#include "service/pipeline/patch_fit.hpp"
#include "service/pipeline/support_check.hpp"
#include "service/pipeline/thin_wall.hpp"
#include "service/pipeline/unseen_share.hpp"

namespace graspd {
namespace {

constexpr float kAmpleRoom = 0.25f;  // share of the aperture left free from which on more does not matter
constexpr float kThin = 0.012f, kThick = 0.022f;  // of objects: narrower is doubtful, wider is not [m]
constexpr float kThinWall = 0.014f;               // and so thin that it must be met squarely [m]
constexpr float kMaxThinMisalignment = 6.0f;      // within this [degrees]
constexpr float kWallErrors = 10;                 // that a rim's wall may be off by: neighbours share noise
constexpr float kMaxBend = 0.0015f;               // of it between the jaws: less than pads yield [m]
constexpr float kAmpleArea = 5e-4f;               // seen between the jaws, beyond what must be [m2]

float radians(float degrees) {
  return degrees * std::numbers::pi_v<float> / 180;
}

/// One check in progress: the gripper at the fitted pose, and the points around it relative to that pose.
class Check {
 public:
  Check(const SceneView& scene, const Gripper& gripper, const HandleCheckConfig& config,
        const Candidate& candidate, CheckBuffers& buffers)
      : scene_(scene),
        gripper_(gripper),
        config_(config),
        candidate_(candidate),
        buffers_(buffers),
        local_(buffers.local),
        between_(buffers.between) {}

  CheckResult run(const PatchFit& fit);

 private:
  [[nodiscard]] float half_opening() const {
    return 0.5f * std::min(gripper_.aperture_m, handle_.width_m + 2 * config_.clearance_m);
  }
  [[nodiscard]] Failure check_volumes();
  [[nodiscard]] Failure check_support() const;
  [[nodiscard]] Failure check_silhouettes();
  [[nodiscard]] Failure check_walls();
  /// How deep the object reaches between the jaws [m].
  [[nodiscard]] float grip_depth() const { return gripper_.grasp_depth_m - top_; }
  [[nodiscard]] bool is_thin_wall(const Contact& low, const Contact& high) const;
  [[nodiscard]] bool check_square(const Contact& low, const Contact& high, bool round);
  [[nodiscard]] Failure check_contacts();
  [[nodiscard]] Failure check_unseen();
  /// Writes to buffers_.selected which points are at these distances from the middle and depths; their
  /// number.
  [[nodiscard]] std::size_t select(float min_distance, float max_distance, float min_depth, float max_depth);
  /// Where what is between the jaws ends.
  void find_ends();
  [[nodiscard]] float hidden_share(const HandBox& box, Hidden what) const;
  [[nodiscard]] float finger_hidden_share(int side, Hidden what) const;
  [[nodiscard]] float area_per_point() const;
  /// Of the object between the jaws [m2].
  [[nodiscard]] float seen_area() const { return area_per_point() * static_cast<float>(num_seen_); }
  void set_width_from(const Contact& low, const Contact& high);
  [[nodiscard]] Eigen::Vector3f squared_axis(const Contact& low, const Contact& high, bool round) const;

  const SceneView& scene_;
  const Gripper& gripper_;
  const HandleCheckConfig& config_;
  const Candidate& candidate_;
  CheckBuffers& buffers_;
  LocalPoints& local_;  // relative to the handle's position
  std::pmr::vector<std::uint32_t>& between_;
  Handle handle_;
  HandleMargins margins_;
  Eigen::Vector3f squared_ = Eigen::Vector3f::Zero();  // closing axis that meets the object squarely
  int num_seen_ = 0;                                   // of the points between the jaws, measured ones
  float end_[2] = {0, 0};  // of the object's points between the jaws, along f from the handle's position
  float top_ = 0;          // their smallest depth
  float side_slope_ = 0;   // of the object's sides against the major axis, df / da, mean of both
};

std::size_t Check::select(float min_distance, float max_distance, float min_depth, float max_depth) {
  return point_kernels().select_band({0, 0, min_distance, max_distance, min_depth, max_depth}, local_.band(),
                                     buffers_.selected.data());
}

Failure Check::check_volumes() {
  const Gripper& g = gripper_;
  const float half = half_opening(), half_hand = 0.5f * g.aperture_m + g.finger_width_m,
              half_e = 0.5f * g.finger_thickness_m;
  const float palm_top = g.grasp_depth_m - g.finger_length_m, hand_top = palm_top - config_.palm_depth_m;
  between_.resize(local_.size() + kPointPadding);
  const BandCounts counts = point_kernels().select_own({0, 0, 0, half, palm_top, g.grasp_depth_m},
                                                       local_.band(), buffers_.own.data(), between_.data());
  between_.resize(counts.own);
  // Those of far sides come last.
  const auto is_far = [&](std::uint32_t k) { return !scene_.is_seen(local_.index[k]); };
  num_seen_ = static_cast<int>(counts.own);
  while (num_seen_ > 0 && is_far(between_[static_cast<std::size_t>(num_seen_) - 1])) --num_seen_;
  handle_.num_points = num_seen_;
  if (num_seen_ < scene_.min_points) return Failure::kTooFewPoints;
  if (static_cast<float>(counts.own) < config_.min_own_share * static_cast<float>(counts.all))
    return Failure::kNoGap;
  const float beside = std::nextafter(half, 1.0f);
  const auto fingers = static_cast<int>(select(beside, half + g.finger_width_m, palm_top, g.grasp_depth_m));
  if (fingers > scene_.tolerance) return Failure::kFingers;
  const auto blocked = [&](float half_width, float z0, float z1) {
    const Eigen::Vector3f min(-half_e, -half_width, z0), max(half_e, half_width, z1);
    return scene_.query.has_more(handle_.position, handle_.rotation, min, max, scene_.tolerance) ||
           (scene_.far_sides != nullptr &&
            scene_.far_sides->has_more(box_test(handle_.position, handle_.rotation, min, max),
                                       scene_.tolerance));
  };
  if (blocked(half_hand, hand_top, palm_top)) return Failure::kPalm;
  return blocked(half_hand, hand_top - config_.way_m, hand_top) ? Failure::kWay : Failure::kNone;
}

Failure Check::check_support() const {
  const bool is_clear =
      is_clear_of_support(scene_, gripper_, config_, handle_, half_opening(), candidate_.object);
  return is_clear ? Failure::kNone : Failure::kSupport;
}

void Check::find_ends() {
  const std::size_t n = between_.size();
  for (std::size_t i = 0; i < n; ++i) {
    buffers_.widths[i] = local_.f[between_[i]];
    buffers_.depths[i] = local_.z[between_[i]];
  }
  const std::span<float> f(buffers_.widths.data(), n), z(buffers_.depths.data(), n);
  const std::size_t skip = std::min(n / 4, std::max<std::size_t>(1, n / 200));
  end_[0] = nth_value(f, skip);
  end_[1] = nth_value(f, skip, std::greater<>());
  top_ = nth_value(z, skip);
}

Failure Check::check_silhouettes() {
  constexpr int kSlabs = 5, kLeastSlabs = 3;
  std::array<float, kSlabs> low, high;
  low.fill(1);
  high.fill(-1);
  const float slabs_per_m = kSlabs / gripper_.finger_thickness_m;
  for (const std::uint32_t k : between_) {
    const float along = local_.a[k] * slabs_per_m + 0.5f * kSlabs;
    const auto slab = static_cast<std::size_t>(std::clamp(static_cast<int>(along), 0, kSlabs - 1));
    low[slab] = std::min(low[slab], local_.f[k]);
    high[slab] = std::max(high[slab], local_.f[k]);
  }
  const float limit = std::tan(radians(config_.max_silhouette_angle_deg));
  side_slope_ = 0;
  for (const auto& side : {low, high}) {
    float n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (int i = 0; i < kSlabs; ++i) {
      if (low[static_cast<std::size_t>(i)] > high[static_cast<std::size_t>(i)]) continue;
      const float x = (static_cast<float>(i) + 0.5f) / kSlabs * gripper_.finger_thickness_m;
      const float y = side[static_cast<std::size_t>(i)];
      n += 1;
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
    if (n < kLeastSlabs) return Failure::kSilhouettes;
    const float slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    if (std::abs(slope) > limit) return Failure::kSilhouettes;
    margins_.silhouettes = std::min(margins_.silhouettes, 1 - std::abs(slope) / limit);
    side_slope_ += 0.5f * slope;
  }
  return Failure::kNone;
}

Failure Check::check_walls() {
  constexpr float kBelow = 0.005f, kBeside = 0.03f, kOfShallow = 0.6f;
  const float above = grip_depth() < config_.min_grip_depth_m ? kOfShallow * grip_depth() : 0.010f;
  const float half = half_opening(), l = gripper_.grasp_depth_m;
  float near_low = 1, near_high = -1, far_low = 1, far_high = -1;
  const auto extend = [&](float max_depth, float& low, float& high) {
    point_kernels().extend_own({0, 0, 0, half + kBeside, l - gripper_.finger_length_m, max_depth},
                               local_.band(), buffers_.own.data(), low, high);
  };
  extend(l + kBelow, far_low, far_high);
  extend(l - above, near_low, near_high);
  if (near_high <= near_low) return Failure::kWalls;
  const float limit = (above + kBelow) * std::tan(radians(config_.max_wall_angle_deg));
  const float widening = std::max(far_high - near_high, near_low - far_low);
  margins_.walls = 1 - widening / limit;
  return widening > limit ? Failure::kWalls : Failure::kNone;
}

float Check::hidden_share(const HandBox& box, Hidden what) const {
  return graspd::hidden_share(scene_, handle_, gripper_.finger_thickness_m, box, what, candidate_.object);
}

float Check::finger_hidden_share(int side, Hidden what) const {
  const float sign = side == 0 ? -1.0f : 1.0f, half = half_opening(), l = gripper_.grasp_depth_m;
  const float z0 = what == Hidden::kByOthers ? l - gripper_.finger_length_m : std::min(top_, l - 0.01f);
  return hidden_share({sign * half, sign * (half + gripper_.finger_width_m), z0, l}, what);
}

/// Every measured point stands for the patch of surface that its ray meets; every one of a sparse copy for
/// its cell's face.
float Check::area_per_point() const {
  return scene_.is_sparse() ? scene_.spacing_m * scene_.spacing_m
                            : scene_.depth_map.ray_area(handle_.position);
}

void Check::set_width_from(const Contact& low, const Contact& high) {
  const float center = 0.5f * (low.reach_m + high.reach_m);
  handle_.width_m = high.reach_m - low.reach_m;
  handle_.position += handle_.rotation.col(1) * center;
  for (std::size_t k = 0; k < local_.size(); ++k) local_.f[k] -= center;
  end_[0] -= center;
  end_[1] -= center;
}

/// The closing axis, in gripper coordinates, that meets the object squarely: along the normals of the walls
/// that are seen, else across its silhouettes. Round objects are turned about the approach only: the seen
/// part of their walls leans towards the sensor.
Eigen::Vector3f Check::squared_axis(const Contact& low, const Contact& high, bool round) const {
  Eigen::Vector3f axis = high.normal - low.normal;
  if (axis.norm() < 0.5f) axis = {-side_slope_, 1, 0};
  if (round) axis.z() = 0;
  return axis.normalized();
}

/// A thin wall that the jaws do not meet squarely is met at its edges, and turns; a thin rod does not.
bool Check::is_thin_wall(const Contact& low, const Contact& high) const {
  const float width = high.reach_m - low.reach_m;
  return width < kThinWall && is_plate(width, grip_depth());
}

/// Whether the jaws would meet the object squarely enough.
bool Check::check_square(const Contact& low, const Contact& high, bool round) {
  Eigen::Vector3f squared = squared_axis(low, high, round);
  float most_off = config_.max_misalignment_deg, doubt = 0;
  if (is_thin_wall(low, high)) {
    const WallShape wall = fit_wall(local_, between_, top_, gripper_);
    if (margins_.has_thin_edge() && wall.bend_m > kMaxBend) return false;
    squared =
        candidate_.is_on_known_wall() ? handle_.rotation.transpose() * candidate_.wall_normal : wall.normal;
    doubt = kWallErrors * candidate_.wall_error_rad;
    most_off = kMaxThinMisalignment;
  } else if (margins_.has_thin_edge()) {
    return false;  // bent or askew: it takes up more room than a thin wall
  }
  squared_ = handle_.rotation * squared;
  const float off = std::acos(std::clamp(squared.y(), -1.0f, 1.0f));
  margins_.square = 1 - (off + doubt) / radians(config_.max_misalignment_deg);
  return off <= radians(most_off);
}

/// How far the walls on both sides lean outwards, down to the fingertips: of a round profile the fitted
/// circle tells it better than normals do [rad].
float lean(const Contact& low, const Contact& high, const ContactInput& in) {
  float sine = 0;
  if (in.circle)
    sine = (in.circle->center.y() - in.depth_m) / in.circle->radius;
  else if (!low.normal.isZero() && !high.normal.isZero())
    sine = -0.5f * (low.normal.z() + high.normal.z());
  return std::asin(std::clamp(sine, 0.0f, 1.0f));
}

/// How far that is from the angle at which jaws with a friction coefficient of 0.5 slip off.
float grip_margin(float lean_rad) {
  constexpr float kHolds = 18, kSlips = 27;  // [degrees]
  return (radians(kSlips) - lean_rad) / radians(kSlips - kHolds);
}

Failure Check::check_contacts() {
  const Eigen::Vector3f approach = handle_.rotation.col(2);
  const Plane* const support = scene_.plane_under(candidate_.object);
  if (seen_area() < config_.min_contact_area_m2 ||
      grip_depth() < least_grip_depth(support, config_, handle_.position + top_ * approach, approach))
    return Failure::kContact;
  buffers_.profile.clear();
  // Where the far side is known, nothing needs to be guessed from the profile.
  if (between_.size() == static_cast<std::size_t>(num_seen_)) {
    const std::size_t step = circle_step(between_.size());
    for (std::size_t i = 0; i < between_.size(); i += step)
      buffers_.profile.emplace_back(local_.f[between_[i]], local_.z[between_[i]]);
  }
  const ContactInput input{scene_,
                           local_,
                           between_,
                           handle_.position,
                           handle_.rotation,
                           top_,
                           gripper_.grasp_depth_m,
                           end_[1] - end_[0],
                           std::cos(radians(config_.max_facing_angle_deg)),
                           gripper_.finger_width_m,
                           gripper_.finger_thickness_m,
                           area_per_point(),
                           radians(config_.max_wall_angle_deg),
                           fit_circle(buffers_.profile, kMaxRadius, circle_tolerance(scene_))};
  const Contact low = find_contact(input, -1, end_[0], finger_hidden_share(0, Hidden::kAtAll), buffers_.face);
  if (low.kind == ContactKind::kNone) return Failure::kContact;
  const Contact high = find_contact(input, 1, end_[1], finger_hidden_share(1, Hidden::kAtAll), buffers_.face);
  if (high.kind == ContactKind::kNone) return Failure::kContact;
  margins_.contact = {low.kind, high.kind};
  margins_.grip = grip_margin(lean(low, high, input));
  if (!check_square(low, high, input.circle.has_value())) return Failure::kContact;
  set_width_from(low, high);
  margins_.width = (gripper_.aperture_m - handle_.width_m) / (kAmpleRoom * gripper_.aperture_m);
  if (!candidate_.is_on_known_wall() || !is_thin_wall(low, high)) {
    margins_.thickness = (handle_.width_m - kThin) / (kThick - kThin);
    margins_.area = (seen_area() - config_.min_contact_area_m2) / kAmpleArea;
  }
  margins_.grip_depth = grip_depth() / gripper_.grasp_depth_m;
  return handle_.width_m > gripper_.aperture_m - 0.002f ? Failure::kTooWide : Failure::kNone;
}

Failure Check::check_unseen() {
  const Gripper& g = gripper_;
  const float most_by_others = 0.5f * config_.max_hidden_share;
  float hidden[2];
  for (int side = 0; side < 2; ++side) {
    hidden[side] = finger_hidden_share(side, Hidden::kAtAll);
    handle_.observed_free[static_cast<std::size_t>(side)] = 1 - hidden[side];
    if (finger_hidden_share(side, Hidden::kByOthers) > most_by_others) return Failure::kUnseen;
  }
  if (std::min(hidden[0], hidden[1]) > config_.max_hidden_share) return Failure::kUnseen;
  margins_.seen = 1 - std::max(hidden[0], hidden[1]);
  const float hand = 0.5f * g.aperture_m + g.finger_width_m, palm_top = g.grasp_depth_m - g.finger_length_m;
  const float hand_top = palm_top - config_.palm_depth_m;
  if (hidden_share({-hand, hand, hand_top, palm_top}, Hidden::kInView) > config_.max_hidden_share)
    return Failure::kUnseen;
  const float way = hidden_share({-hand, hand, hand_top - config_.way_m, palm_top}, Hidden::kByOthers);
  return way > most_by_others ? Failure::kUnseen : Failure::kNone;
}

CheckResult Check::run(const PatchFit& fit) {
  handle_.rotation = candidate_.rotation;
  handle_.segment = candidate_.segment;
  handle_.position = candidate_.position + candidate_.rotation * Eigen::Vector3f(0, fit.center_m, fit.top_m);
  handle_.width_m = fit.width_m;
  handle_.gap_m = fit.gap_m;
  CheckResult result;
  const auto passes = [&result](Failure failure) { return (result.failure = failure) == Failure::kNone; };
  if (!passes(check_volumes()) || !passes(check_support())) return result;
  find_ends();
  if (!passes(check_silhouettes()) || !passes(check_walls()) || !passes(check_contacts())) return result;
  // The contacts may have moved and widened the opening into space that nothing was seen in: look again.
  if (!passes(check_volumes()) || !passes(check_support())) return result;
  find_ends();
  if (!passes(check_unseen())) return result;
  // What is known of a far side is one body's.
  if (between_.size() == static_cast<std::size_t>(num_seen_))
    margins_.one_face = one_face(scene_, local_, between_, handle_.rotation.col(2));
  result.handle = handle_;
  result.margins = margins_;
  result.squared_axis = squared_;
  return result;
}

}  // namespace

std::string_view name(Failure failure) {
  constexpr std::array<std::string_view, kNumFailures + 1> kNames{
      "too_few_points", "too_wide",    "no_gap", "fingers", "palm",   "way",
      "support",        "silhouettes", "walls",  "contact", "unseen", "none"};
  return kNames[static_cast<std::size_t>(failure)];
}

CheckResult check_candidate(const SceneView& scene, const Gripper& gripper, const HandleCheckConfig& config,
                            const Candidate& candidate, CheckBuffers& buffers) {
  PatchFit fit;
  if (const Failure failure = fit_patch(scene, gripper, config, candidate, buffers, fit);
      failure != Failure::kNone)
    return {failure, {}, {}};
  return Check(scene, gripper, config, candidate, buffers).run(fit);
}

}  // namespace graspd
