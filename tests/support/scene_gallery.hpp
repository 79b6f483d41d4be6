// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The scenes that handle detection must get right, seen by one camera from the front and above. The table is
// z = 0 and always solid 0; objects follow in the order of their names.
#pragma once
#include "tests/support/analytic_scene.hpp"

namespace graspd {

[[nodiscard]] AnalyticSolid table();
/// Standing on z = 0 at (x, y), turned by yaw about z.
[[nodiscard]] AnalyticSolid standing_box(double x, double y, const Eigen::Vector3d& edges,
                                         double yaw_rad = 0);
[[nodiscard]] AnalyticSolid standing_cylinder(double x, double y, double radius, double height);
/// Its axis along the direction of yaw.
[[nodiscard]] AnalyticSolid lying_cylinder(double x, double y, double radius, double length,
                                           double yaw_rad = 0);

/// Camera 0.7 m away from the middle of the table, looking down at about 50 degrees.
[[nodiscard]] AnalyticScene on_table(std::vector<AnalyticSolid> objects);

/// 50 mm x 120 mm x 80 mm, the narrow side towards the camera.
[[nodiscard]] AnalyticScene box_on_table();
/// 60 mm across, 120 mm high.
[[nodiscard]] AnalyticScene cylinder_on_table();
/// 50 mm across, 140 mm long, across the line of sight.
[[nodiscard]] AnalyticScene lying_cylinder_on_table();
/// The paper's figure 6: a bottle that touches a lower box, 70 mm high; only above it are there gaps.
[[nodiscard]] AnalyticScene bottle_beside_box();
/// Two boxes of 50 mm x 100 mm that touch along their long sides; the left one is 40 mm higher.
[[nodiscard]] AnalyticScene touching_boxes();
/// 120 mm x 120 mm x 100 mm.
[[nodiscard]] AnalyticScene too_wide_box();
/// Three boxes of equal height side by side without a gap, each 50 mm x 120 mm.
[[nodiscard]] AnalyticScene wedged_boxes();
/// 3 x 3 stacked boxes that touch on all sides, their fronts staggered by 8 mm, against a wall.
[[nodiscard]] AnalyticScene wall_of_boxes();
/// Box, lying and standing cylinder well apart, turned.
[[nodiscard]] AnalyticScene three_objects();
/// A block of 400 mm x 260 mm x 120 mm on the right, with the box of 50 mm x 120 mm x 80 mm on it; left of it
/// on the table a cylinder, 60 mm across, and a box of 40 mm x 100 mm x 60 mm. Camera 0.9 m away.
[[nodiscard]] AnalyticScene block_on_table();
/// Two boards of 700 mm x 280 mm, 320 mm apart, with a wall behind, and a box of 50 mm x 100 mm x 80 mm and a
/// cylinder, 60 mm across, on each; the lower board is solid 0, the upper one 1, the wall 2. Camera 0.9 m
/// away.
[[nodiscard]] AnalyticScene shelf();
/// Nine boxes and cylinders spread over the table; camera: VGA, 0.9 m away.
[[nodiscard]] AnalyticScene spread_objects();

}  // namespace graspd
