// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One analytic scene as the checks see it: every point of the cloud, with the surfaces found in it.
#pragma once
#include <array>

#include "service/pipeline/contact.hpp"
#include "service/pipeline/handle_check.hpp"
#include "service/pipeline/surfaces.hpp"
#include "tests/support/analytic_scene.hpp"

namespace graspd {

class CheckScene {
 public:
  explicit CheckScene(const AnalyticScene& scene);
  CheckScene(const CheckScene&) = delete;
  CheckScene& operator=(const CheckScene&) = delete;

  [[nodiscard]] const SceneView& view() const { return view_; }

  /// A gripper that comes along approach and closes along closing, at right angles; for the object of the
  /// measured point that is nearest to position.
  [[nodiscard]] Candidate candidate(const Eigen::Vector3f& position, const Eigen::Vector3f& approach,
                                    const Eigen::Vector3f& closing) const;

  /// What the jaws at the candidate's pose, taken as it is, meet at -y and +y.
  [[nodiscard]] std::array<Contact, 2> contacts(const Candidate& candidate,
                                                const Gripper& gripper = {}) const;

 private:
  [[nodiscard]] std::int32_t object_of(std::size_t point) const {
    return surfaces_.objects.of_point[surfaces_.voxel_of_point[point]];
  }
  /// Share of a finger's volume that is hidden, when it stands beside f_m.
  [[nodiscard]] float hidden_share(const Candidate& candidate, const Gripper& gripper, float f_m,
                                   float side) const;

  PointCloud cloud_;
  Surfaces surfaces_;
  DepthMap depth_map_;
  SceneView view_;
};

}  // namespace graspd
