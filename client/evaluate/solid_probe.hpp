// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a hand meets of a scene's true solids: matter within a box, and what a pad's face touches first.
#pragma once
#include <Eigen/Geometry>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "client/simulate/scene.hpp"

namespace graspd {

inline constexpr std::size_t kNoSolid = std::numeric_limits<std::size_t>::max();

/// A scene made ready for many questions. The scene must outlive it.
class SolidProbe {
 public:
  explicit SolidProbe(const Scene& scene);

  [[nodiscard]] const Scene& scene() const { return *scene_; }

  /// The solids that may have matter within the box, a hand's own frame; ascending.
  [[nodiscard]] std::vector<std::size_t> near(const Eigen::Isometry3d& T_world_hand,
                                              const Eigen::AlignedBox3d& box) const;

 private:
  const Scene* scene_;
  std::vector<Eigen::Vector3d> center_;  // of a ball around each solid, in the world frame
  std::vector<double> radius_;
};

/// Whether a solid has matter deeper than depth_m below its surface within the box; T takes the box's
/// coordinates to the solid's. Exact to 0.25 mm where the solid's signed distance is.
[[nodiscard]] bool reaches_into(const Solid& solid, const Eigen::Isometry3d& T_solid_box,
                                const Eigen::AlignedBox3d& box, double depth_m);

/// What one spot of a pad's face meets; the normal in the hand's frame, out of the solid.
struct PadHit {
  double travel_m = std::numeric_limits<double>::infinity();  ///< of the face until it meets the solid
  std::size_t solid = kNoSolid;
  Eigen::Vector3d spot = Eigen::Vector3d::Zero();  ///< where, in the hand's frame
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// A pad's flat face and how it moves, in the hand's frame.
struct PadSweep {
  Eigen::AlignedBox3d face;  ///< flat along y
  double direction = -1;     ///< along y: +1 or -1
  double reach_m = 0;        ///< how far it can move
  double spacing_m = 0.002;  ///< between the spots, about
};

/// For each spot, row by row: what it meets first of the given solids.
[[nodiscard]] std::vector<PadHit> sweep_pad(const Scene& scene, std::span<const std::size_t> solids,
                                            const Eigen::Isometry3d& T_world_hand, const PadSweep& sweep);

}  // namespace graspd
