// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Which objects of a scene the gripper can hold, from where a camera sees them: a brute-force search over
// poses on the true geometry. The denominator of recall.
#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "client/evaluate/solid_judge.hpp"
#include "client/evaluate/visible_objects.hpp"

namespace graspd {

/// Lengths in metres.
struct GraspSearchConfig {
  int min_pixels = 300;           ///< an object that is seen less does not count
  double min_surface_m2 = 6e-4;   ///< the same
  double spot_spacing_m = 0.018;  ///< between the places on the visible surface that are tried
  int max_spots = 48;             ///< of an object, evenly taken from them
  int closing_directions = 18;    ///< in half a turn about the approach
  int min_poses = 3;              ///< robust ones that an object needs
  int min_undisturbed = 8;        ///< of 12 disturbances that a robust pose holds in
  double max_behind_deg = 80;     ///< between the way back along the approach and the line of sight
};

struct GraspableSolid {
  std::size_t solid = kNoSolid;  ///< index into the scene
  std::uint32_t label = 0;
  int pixels = 0;  ///< that the camera sees of it
  std::pmr::vector<Handle>
      poses;  ///< robust ones, in the world frame; min_poses where it can be held, else fewer
  bool graspable = false;
};

/// All objects that are seen enough, in the order of the scene. frame: what an ideal camera sees of the
/// judge's scene. Work is split over the calling thread's oneTBB arena; the result does not depend on it.
[[nodiscard]] std::vector<GraspableSolid> graspable_solids(const SolidJudge& judge, const DepthFrame& frame,
                                                           const Eigen::Isometry3d& T_world_camera,
                                                           const GraspSearchConfig& config = {});

/// In how many of the 12 disturbances of disturbance.hpp a handle holds the same solid as without.
[[nodiscard]] int undisturbed(const SolidJudge& judge, const Handle& handle_world, std::size_t solid);

}  // namespace graspd
