// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/solid_judge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "client/common/text.hpp"

namespace graspd {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr std::array<double, 2> kSides{-1, 1};

/// The hand around a handle, in the gripper's frame.
struct Hand {
  Eigen::Isometry3d T_world_hand = Eigen::Isometry3d::Identity();
  double half_opening = 0;
  double half_thickness, front, back;  ///< of a finger: along x; its tip and its root along z
  double half_width;                   ///< of the palm, along y
  double finger_width;

  Hand(const Handle& handle, const Gripper& gripper, const SolidJudgeConfig& config) {
    // Single precision leaves a rotation a little askew.
    T_world_hand.linear() = Eigen::Quaterniond(handle.rotation.cast<double>()).normalized().matrix();
    T_world_hand.translation() = handle.position.cast<double>();
    const double opening = double(handle.width_m) + 2 * config.clearance_m;
    half_opening = 0.5 * std::min(double(gripper.aperture_m), opening);
    half_thickness = 0.5 * double(gripper.finger_thickness_m);
    front = double(gripper.grasp_depth_m);
    back = front - double(gripper.finger_length_m);
    finger_width = double(gripper.finger_width_m);
    half_width = 0.5 * double(gripper.aperture_m) + finger_width;
  }

  /// Between two distances from the middle, on one side.
  [[nodiscard]] AlignedBox3d beside(double side, double near, double far) const {
    AlignedBox3d box;
    box.extend(Vector3d(-half_thickness, side * near, back));
    box.extend(Vector3d(half_thickness, side * far, front));
    return box;
  }
  [[nodiscard]] AlignedBox3d finger(double side) const {
    return beside(side, half_opening, half_opening + finger_width);
  }
  /// As wide as the palm, between two distances behind the fingers' roots.
  [[nodiscard]] AlignedBox3d behind(double near, double far) const {
    return {Vector3d(-half_thickness, -half_width, back - far),
            Vector3d(half_thickness, half_width, back - near)};
  }
};

/// What one jaw touches when it has closed.
struct Contact {
  double travel_m = std::numeric_limits<double>::infinity();
  std::size_t solid = kNoSolid;
  double top = std::numeric_limits<double>::infinity();  ///< smallest z of the object at this jaw
  std::vector<PadHit> spots;                             ///< touched
  Vector3d normal = Vector3d::Zero();                    ///< mean, unit length
  double area_m2 = 0;                                    ///< touched within the friction cone
};

/// The cosine between the line through two touched spots and the normal that is farther from it, for the two
/// spots where it is largest. Pads press with their faces: a line through any two of their spots will do.
double best_line(const Contact& negative, const Contact& positive) {
  constexpr std::size_t kMany = 64;
  const std::size_t step0 = negative.spots.size() / kMany + 1, step1 = positive.spots.size() / kMany + 1;
  double best = -1;
  for (std::size_t i = 0; i < negative.spots.size(); i += step0) {
    for (std::size_t k = 0; k < positive.spots.size(); k += step1) {
      const PadHit &a = negative.spots[i], &b = positive.spots[k];
      const Vector3d line = (b.spot - a.spot).normalized();
      best = std::max(best, std::min(-a.normal.dot(line), b.normal.dot(line)));
    }
  }
  return best;
}

class Check {
 public:
  Check(const SolidProbe& probe, const SolidJudgeConfig& config, const Hand& hand)
      : probe_(probe), config_(config), hand_(hand), near_(probe.near(hand.T_world_hand, whole())) {}

  SolidVerdict run() {
    verdict_.failure = way_in();
    if (verdict_.failure == SolidFailure::kNone) verdict_.failure = closing();
    return verdict_;
  }

 private:
  [[nodiscard]] AlignedBox3d whole() const {
    return hand_.behind(0, config_.palm_depth_m + config_.way_m)
        .merged(hand_.finger(-1))
        .merged(hand_.finger(1));
  }

  [[nodiscard]] bool is_support(std::size_t i) const {
    return probe_.scene().solids[i].label == kLabelSupport;
  }

  [[nodiscard]] bool is_wall(std::size_t i) const { return probe_.scene().solids[i].label == kLabelBinWall; }

  [[nodiscard]] bool is_in(std::size_t i, const AlignedBox3d& box) const {
    const Solid& solid = probe_.scene().solids[i];
    const Eigen::Isometry3d T_solid_hand = solid.T_world_solid.inverse() * hand_.T_world_hand;
    return reaches_into(solid, T_solid_hand, box, config_.penetration_m);
  }

  /// What the box goes into: the support before anything else.
  SolidFailure collision(const AlignedBox3d& box, SolidFailure failure) {
    if (in_support(box)) return SolidFailure::kSupport;
    for (const std::size_t i : near_) {
      if (is_support(i) || !is_in(i, box)) continue;
      verdict_.blocker = i;
      return failure;
    }
    return SolidFailure::kNone;
  }

  bool in_support(const AlignedBox3d& box) {
    for (const std::size_t i : near_) {
      if (!is_support(i) || !is_in(i, box)) continue;
      verdict_.blocker = i;
      return true;
    }
    return false;
  }

  SolidFailure way_in() {
    const double palm = config_.palm_depth_m;
    for (const auto& [box, failure] :
         {std::pair{hand_.finger(-1), SolidFailure::kFinger},
          std::pair{hand_.finger(1), SolidFailure::kFinger},
          std::pair{hand_.behind(0, palm), SolidFailure::kPalm},
          std::pair{hand_.behind(palm, palm + config_.way_m), SolidFailure::kWay}}) {
      if (const auto hit = collision(box, failure); hit != SolidFailure::kNone) return hit;
    }
    return SolidFailure::kNone;
  }

  /// Where pads start to look for contact: clear of what an open finger may be within.
  [[nodiscard]] double outside() const { return hand_.half_opening + 2 * config_.penetration_m; }

  Contact contact(double side) const {
    const double start = outside();
    const PadSweep sweep{hand_.beside(side, start, start), -side, start + hand_.half_opening,
                         config_.pad_spacing_m};
    std::vector<std::size_t> movable;
    for (const std::size_t i : near_)
      if (!is_support(i)) movable.push_back(i);
    const auto hits = sweep_pad(probe_.scene(), movable, hand_.T_world_hand, sweep);
    const double cell = sweep.face.sizes().x() * sweep.face.sizes().z() / double(hits.size());
    return touched(hits, side, cell);
  }

  [[nodiscard]] Contact touched(const std::vector<PadHit>& hits, double side, double cell_m2) const {
    Contact contact;
    for (const PadHit& hit : hits) {
      if (hit.travel_m >= contact.travel_m) continue;
      contact.travel_m = hit.travel_m;
      contact.solid = hit.solid;
    }
    if (contact.solid == kNoSolid) return contact;
    const double cone = std::cos(std::atan(config_.friction));
    for (const PadHit& hit : hits) {
      if (hit.solid != contact.solid) continue;
      contact.top = std::min(contact.top, hit.spot.z());
      if (hit.travel_m > contact.travel_m + config_.pad_give_m) continue;
      contact.spots.push_back(hit);
      contact.normal += hit.normal;
      if (side * hit.normal.y() >= cone) contact.area_m2 += cell_m2;
    }
    contact.normal.normalize();
    return contact;
  }

  void measure(const std::array<Contact, 2>& jaws) {
    const double open = outside();
    const double low = -open + jaws[0].travel_m, high = open - jaws[1].travel_m;
    verdict_.width_m = high - low;
    verdict_.off_center_m = 0.5 * (high + low);
    // Spots are the middles of cells.
    verdict_.depth_m = hand_.front - std::min(jaws[0].top, jaws[1].top) + 0.5 * config_.pad_spacing_m;
    for (std::size_t i = 0; i < 2; ++i) {
      verdict_.contact_deg[i] = kDegrees * std::acos(std::clamp(kSides[i] * jaws[i].normal.y(), -1.0, 1.0));
      verdict_.contact_m2[i] = jaws[i].area_m2;
    }
  }

  SolidFailure closing() {
    const std::array<Contact, 2> jaws{contact(-1), contact(1)};
    verdict_.solid = jaws[0].solid != kNoSolid ? jaws[0].solid : jaws[1].solid;
    if (jaws[0].solid == kNoSolid || jaws[1].solid == kNoSolid) return SolidFailure::kNothing;
    if (jaws[0].solid != jaws[1].solid) return SolidFailure::kTwoObjects;
    if (is_wall(verdict_.solid)) return SolidFailure::kFixed;
    measure(jaws);
    for (std::size_t i = 0; i < 2; ++i) {
      // Closing at a slant, a jaw may sink into the support; anything else in its way it would have met
      // first.
      const double open = hand_.half_opening;
      const double closed = outside() - jaws[i].travel_m;
      if (closed < open && in_support(hand_.beside(kSides[i], closed, open))) return SolidFailure::kSupport;
    }
    return grip(jaws);
  }

  SolidFailure grip(const std::array<Contact, 2>& jaws) {
    if (std::abs(verdict_.off_center_m) > config_.max_off_center_m) return SolidFailure::kOffCenter;
    if (verdict_.depth_m < config_.min_depth_m) return SolidFailure::kShallow;
    const double cone_deg = kDegrees * std::atan(config_.friction);
    if (std::max(verdict_.contact_deg[0], verdict_.contact_deg[1]) > cone_deg) return SolidFailure::kFriction;
    if (std::min(jaws[0].area_m2, jaws[1].area_m2) < config_.min_contact_m2) return SolidFailure::kContact;
    verdict_.line_deg = kDegrees * std::acos(std::clamp(best_line(jaws[0], jaws[1]), -1.0, 1.0));
    if (verdict_.line_deg > cone_deg) return SolidFailure::kOpposite;
    return SolidFailure::kNone;
  }

  const SolidProbe& probe_;
  const SolidJudgeConfig& config_;
  const Hand& hand_;
  std::vector<std::size_t> near_;
  SolidVerdict verdict_;
};

}  // namespace

std::string_view name(SolidFailure failure) {
  constexpr std::array<std::string_view, kNumSolidFailures + 1> kNames{
      "support",    "finger",  "palm",     "way",     "nothing",  "two_objects", "fixed",
      "off_center", "shallow", "friction", "contact", "opposite", "none"};
  return kNames[static_cast<std::size_t>(failure)];
}

std::string SolidVerdict::text(const Scene& scene) const {
  const auto kind = [&](std::size_t i) {
    return i == kNoSolid ? std::string("-")
                         : printed("%s %u", scene.solids[i].kind.c_str(), scene.solids[i].label);
  };
  std::string line = std::string(name(failure)) + "; object " + kind(solid) + "; blocked by " + kind(blocker);
  if (width_m > 0)
    line += printed(
        "; width %.1f mm, off centre %.1f mm, depth %.1f mm, contacts %.0f and %.0f degrees, %.0f and %.0f "
        "mm2, "
        "line %.0f degrees",
        1e3 * width_m, 1e3 * off_center_m, 1e3 * depth_m, contact_deg[0], contact_deg[1], 1e6 * contact_m2[0],
        1e6 * contact_m2[1], line_deg);
  return line;
}

SolidJudge::SolidJudge(const Scene& scene, const Gripper& gripper, const SolidJudgeConfig& config)
    : probe_(scene), gripper_(gripper), config_(config) {}

SolidVerdict SolidJudge::judge(const Handle& handle_world) const {
  const Hand hand(handle_world, gripper_, config_);
  return Check(probe_, config_, hand).run();
}

SolidVerdict judge_on_solids(const Scene& scene, const Handle& handle_world, const Gripper& gripper,
                             const SolidJudgeConfig& config) {
  return SolidJudge(scene, gripper, config).judge(handle_world);
}

}  // namespace graspd
