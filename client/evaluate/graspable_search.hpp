// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Which objects can be held at all: a brute-force search over poses with the judge and the labels, against
// which detection without labels is measured.
#pragma once
#include <string>
#include <vector>

#include "client/evaluate/label_judge.hpp"

namespace graspd {

/// An object counts as graspable with this many poses.
inline constexpr int kMinGraspablePoses = 3;
/// A pose counts when it stays valid in so many of the disturbances.
inline constexpr int kMinSteadyPoses = 8;

struct GraspableObject {
  int object = kNoObject;
  int points = 0;
  int poses = 0;  ///< steady valid poses, counted up to kMinGraspablePoses
};

/// Every object of the scene with at least min_points, ascending. Work is split over the calling thread's
/// oneTBB arena; the result does not depend on how.
[[nodiscard]] std::vector<GraspableObject> find_graspable(const LabelScene& scene, const Gripper& gripper,
                                                          int min_points);

/// Lines `frame,object,points,poses`, with their header.
[[nodiscard]] std::string graspable_csv_header();
[[nodiscard]] std::string graspable_csv_rows(const std::string& frame,
                                             const std::vector<GraspableObject>& objects);

}  // namespace graspd
