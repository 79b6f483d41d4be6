// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a jaw would meet where the object ends on its side: a wall that was seen, an edge whose wall is out of
// sight, or nothing that can be relied on.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>

#include "service/pipeline/circle_fit.hpp"
#include "service/pipeline/gripper.hpp"
#include "service/pipeline/point_kernels.hpp"
#include "service/pipeline/raw_vector.hpp"
#include "service/pipeline/scene_view.hpp"

namespace graspd {

enum class ContactKind : std::uint8_t {
  kNone,        ///< not to be relied on: an occlusion border, a wedge, or too little seen
  kWall,        ///< a wall that faces the jaw was seen
  kFreeEdge,    ///< an edge with seen free space beside it; the wall itself is out of sight
  kCurvedEdge,  ///< beside hidden space: the face carried on as a circle stays clear of the finger
  kFlatEdge,    ///< beside hidden space: the face is flat and ends in a wall at a right angle
  kThinEdge,    ///< the edge of a thin wall whose other face is out of sight
};

/// Where the candidate is in the scene, and which of the local points are the object's between the jaws.
struct ContactInput {
  const SceneView& scene;
  const LocalPoints& local;  ///< coordinates relative to position
  const std::pmr::vector<std::uint32_t>&
      between;  ///< positions in local of the object's points between the jaws
  Eigen::Vector3f position;
  Eigen::Matrix3f rotation;
  float top_m;     ///< smallest depth of those points
  float depth_m;   ///< of the fingertips: l
  float extent_m;  ///< of those points along the closing axis
  float min_facing_cosine;
  float finger_width_m;
  float finger_thickness_m;
  float area_per_point_m2;   ///< of the surface that one of the points stands for
  float max_wall_angle_rad;  ///< between the jaw and a wall that leans outwards towards the fingertips
  std::optional<Circle>
      circle;  ///< through the profile (closing axis, depth) of those points, where they are round
};

struct Contact {
  ContactKind kind = ContactKind::kNone;
  float reach_m =
      0;  ///< how far out, along the closing axis, the object goes: seen, or carried on into hidden space
  /// Mean outward normal of a wall, in gripper coordinates; zero for the other kinds.
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

/// Points of the face near an end: distance inwards from the end, depth, and place along the major axis.
/// Working memory of find_contact().
struct EndFace {
  RawVector<float> in, z, a;
  std::size_t size = 0;

  /// Empties it; room for so many and for what the kernels read beyond them.
  void start(std::size_t most) {
    size = 0;
    if (in.size() >= most + kPointPadding) return;
    for (RawVector<float>* v : {&in, &z, &a}) v->resize(2 * (most + kPointPadding));
  }
  void add(float distance, float depth, float along) {
    in[size] = distance;
    z[size] = depth;
    a[size++] = along;
  }
};

/// Of circles that a profile may be part of; larger ones count as flat [m].
inline constexpr float kMaxRadius = 0.06f;

/// How far from a circle points of a round profile may be, by the sensor's scatter [m]: the closer, the
/// better an edge with two of its faces is told from one.
[[nodiscard]] float circle_tolerance(const SceneView& scene);

/// Whether what reaches so deep between the jaws can be a plate met at its edge: of a rod there is no more of
/// it than it is wide.
[[nodiscard]] inline bool is_plate(float width_m, float depth_m) {
  return depth_m > 1.2f * width_m;
}

/// side: -1 or +1 along the closing axis; end_m: where the object's seen points end there; hidden_share: of
/// the finger's volume beside it.
[[nodiscard]] Contact find_contact(const ContactInput& in, float side, float end_m, float hidden_share,
                                   EndFace& face);

}  // namespace graspd
