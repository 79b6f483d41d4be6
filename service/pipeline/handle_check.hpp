// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether the gripper can take a candidate: the volumes of fingers, palm and hand against everything in the
// cloud, the support, the shape between the jaws, what each jaw would touch, and what the sensor has not
// seen.
#pragma once
#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <string_view>
#include <vector>

#include "service/pipeline/gripper.hpp"
#include "service/pipeline/handle.hpp"
#include "service/pipeline/handle_score.hpp"
#include "service/pipeline/scene_view.hpp"

namespace graspd {

/// Why a candidate is no handle, in the order of the checks.
enum class Failure : std::uint8_t {
  kTooFewPoints,  ///< too little of the object between the jaws
  kTooWide,       ///< wider than the aperture
  kNoGap,         ///< something else between the jaws, or no gap of g beside the object
  kFingers,       ///< a finger would hit something
  kPalm,          ///< the palm would
  kWay,           ///< the hand would, on its way in
  kSupport,       ///< a fingertip or the hand would go below the support
  kSilhouettes,   ///< the sides run so much across the major axis that the jaws would slip
  kWalls,         ///< the sides widen so much towards the fingertips that the jaws would slide off
  kContact,       ///< a jaw would not meet a wall
  kUnseen,        ///< too much of the hand would go where the sensor did not look
  kNone
};
inline constexpr std::size_t kNumFailures = static_cast<std::size_t>(Failure::kNone);
using FailureCounts = std::array<int, kNumFailures>;

/// lower_snake, as on the wire.
[[nodiscard]] std::string_view name(Failure failure);

struct HandleCheckConfig {
  float clearance_m = 0.004f;
  float palm_depth_m = 0.020f;
  float way_m = 0.100f;
  float support_clearance_m = 0.0f;
  float min_own_share = 0.90f;
  float min_grip_depth_m = 0.012f;
  float min_grip_share = 0.6f;
  float min_contact_area_m2 = 1e-4f;
  float max_silhouette_angle_deg = 35.0f;
  float max_wall_angle_deg = 30.0f;
  float max_facing_angle_deg = 37.0f;
  float max_misalignment_deg = 50.0f;
  float max_hidden_share = 0.5f;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("clearance_m", self.clearance_m, Range{0, 0.05},
      "free on each side of the object when the jaws are around it [m]");
    v("palm_depth_m", self.palm_depth_m, Range{0, 0.3}, "of the palm behind the fingers [m]");
    v("way_m", self.way_m, Range{0, 1}, "how far back along the approach the hand must be free [m]");
    v("support_clearance_m", self.support_clearance_m, Range{-0.01, 0.05},
      "fingertips stay this high above the support [m]");
    v("min_own_share", self.min_own_share, Range{0, 1},
      "share of the points between the jaws that belong to one object");
    v("min_grip_depth_m", self.min_grip_depth_m, Range{0.001, 0.1},
      "how deep the object must reach between the jaws [m]");
    v("min_grip_share", self.min_grip_share, Range{0.5, 1},
      "of the height above the support of what is so low that this is less");
    v("min_contact_area_m2", self.min_contact_area_m2, Range{0, 0.01},
      "how much of it must be seen between the jaws [m2]");
    v("max_silhouette_angle_deg", self.max_silhouette_angle_deg, Range{1, 89},
      "between the object's sides and the major axis [degrees]");
    v("max_wall_angle_deg", self.max_wall_angle_deg, Range{1, 89},
      "by which the sides may widen towards the fingertips [degrees]");
    v("max_facing_angle_deg", self.max_facing_angle_deg, Range{0, 90},
      "between a wall's normal and the jaw [degrees]");
    v("max_misalignment_deg", self.max_misalignment_deg, Range{1, 89},
      "between the closing axis and what would meet the object's walls or sides squarely [degrees]");
    v("max_hidden_share", self.max_hidden_share, Range{0, 1},
      "share of a finger's volume that may be hidden, one finger excepted");
  }
};

/// A gripper pose on an object, before it is checked.
struct Candidate {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();      ///< on the object, about between the jaws
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();  ///< columns: major axis, closing axis, approach
  std::int32_t segment = -1;
  std::int32_t object = -1;
  /// How far the fingertips go below the object's top at most [m]; the gripper may allow less.
  float depth_m = std::numeric_limits<float>::infinity();
  /// Of a thin wall between the jaws, as more of it than is there tells; zero: not known.
  Eigen::Vector3f wall_normal = Eigen::Vector3f::Zero();
  float wall_error_rad = 0;  ///< how sure that is (RimWall::error_rad)

  [[nodiscard]] bool is_on_known_wall() const { return !wall_normal.isZero(); }
};

struct CheckResult {
  Failure failure = Failure::kTooFewPoints;
  Handle handle;          ///< valid when failure is kNone; position and width fitted to the object
  HandleMargins margins;  ///< the same
  /// The same: unit closing axis, in the cloud's frame, with which the jaws would meet the object squarely.
  Eigen::Vector3f squared_axis = Eigen::Vector3f::Zero();
};

/// Working memory of a check, kept from call to call.
struct CheckBuffers {
  LocalPoints local;                     ///< around the candidate, relative to its fitted position
  std::pmr::vector<std::int32_t> own;    ///< 1 for each of them that is the candidate's object's
  std::pmr::vector<std::int32_t> marks;  ///< and what it leaves in the profile (BandTags)
  std::pmr::vector<std::uint32_t> between;
  std::pmr::vector<std::uint32_t> selected;  ///< room for one of each of them and the kernels' padding
  std::pmr::vector<std::uint8_t> marked;     ///< 1 for each mark of the profile that a point left
  std::pmr::vector<float> depths, widths;    ///< room for one value a point and the kernels' padding
  std::pmr::vector<Eigen::Vector2f> profile;
  EndFace face;
};

/// Those of each thread. A check lends them to nobody else: it splits no work.
using CheckBuffersOfThreads =
    tbb::enumerable_thread_specific<CheckBuffers, std::pmr::polymorphic_allocator<CheckBuffers>>;

/// Fits position and width to what is between the jaws, then checks. A pure function of its arguments
/// (buffers aside).
[[nodiscard]] CheckResult check_candidate(const SceneView& scene, const Gripper& gripper,
                                          const HandleCheckConfig& config, const Candidate& candidate,
                                          CheckBuffers& buffers);

}  // namespace graspd
