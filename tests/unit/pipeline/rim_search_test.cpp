// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/rim_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "service/pipeline/detect_handles.hpp"
#include "service/pipeline/surfaces.hpp"
#include "service/pipeline/workspace_filter.hpp"
#include "tests/support/scene_gallery.hpp"

namespace graspd {
namespace {

constexpr float kTolerance = 0.25f;  // [rad]

/// A corner ends along both of its sides.
bool is_at_corner(const Candidate& candidate) {
  return std::abs(candidate.position.x()) > 0.05f;
}

std::pmr::vector<Candidate> rims(const AnalyticScene& scene) {
  const WorkspaceResult kept = filter_workspace(render(scene).cloud, {});
  const Surfaces s = find_surfaces(kept.cloud, {}, [](std::string_view) {});
  const ObjectPoints points = points_by_object(s.objects);
  const SearchInput input{s.cloud, s.normals, s.segments, s.objects, points, s.support};
  std::pmr::vector<Candidate> all;
  for (int object = 0; object < s.objects.num_objects; ++object)
    for (const Candidate& c : rim_candidates(input, static_cast<std::size_t>(object), {}, {})) {
      EXPECT_EQ(c.object, object);
      all.push_back(c);
    }
  return all;
}

AnalyticScene standing_plate() {
  return on_table({standing_box(0, 0, {0.12, 0.006, 0.08})});
}

TEST(RimSearch, NothingSeenNoRims) {
  const PointCloud cloud;
  Objects objects;
  objects.num_objects = 1;
  const Segments segments;
  const Normals normals;
  const ObjectPoints points = points_by_object(objects);
  Support on_floor;
  on_floor.plane = {Eigen::Vector3f::UnitZ(), 0};
  const std::optional<Support> support = on_floor;
  EXPECT_TRUE(rim_candidates({cloud, normals, segments, objects, points, support}, 0, {}, {}).empty());
}

TEST(RimSearch, TheHandComesAlongAPlateAndClosesAcrossIt) {
  const std::pmr::vector<Candidate> found = rims(standing_plate());
  ASSERT_GE(found.size(), 5u) << "one every 12.5 mm";
  for (const Candidate& c : found) {
    EXPECT_NEAR(c.rotation.determinant(), 1, 1e-4);
    EXPECT_GT(c.position.z(), 0.070f);
    // Of a short strip at a corner little is left.
    const bool is_short = is_at_corner(c) && c.depth_m < Gripper{}.grasp_depth_m;
    EXPECT_GT(std::abs(c.rotation(1, 1)), std::cos(is_short ? kTolerance : 0.1f)) << "across the plate";
    if (is_at_corner(c)) continue;
    EXPECT_LT(c.rotation(2, 2), -std::cos(kTolerance)) << "from above";
  }
}

TEST(RimSearch, APlateThatLeansIsTakenAlongItsLean) {
  constexpr double kLean = 0.35;
  AnalyticSolid plate = standing_box(0, 0, {0.12, 0.006, 0.09});
  plate.T_scene_solid.rotate(Eigen::AngleAxisd(kLean, Eigen::Vector3d::UnitX()));
  const Eigen::Vector3f along = plate.T_scene_solid.linear().col(2).cast<float>();
  const std::pmr::vector<Candidate> found = rims(on_table({plate}));
  ASSERT_GE(found.size(), 5u);
  for (const Candidate& c : found) {
    if (is_at_corner(c)) continue;
    EXPECT_LT(c.rotation.col(2).dot(along), -std::cos(kTolerance));
  }
}

TEST(RimSearch, ABoxHasNoRim) {
  EXPECT_TRUE(rims(box_on_table()).empty()) << "its top goes on where its front ends";
}

TEST(RimSearch, AThinPlateIsHeldAtItsEdge) {
  const Detection detection = detect_handles(render(standing_plate()).cloud, {}, {});
  ASSERT_GE(detection.handles.size(), 1u);
  for (const Handle& handle : detection.handles) {
    EXPECT_GT(std::abs(handle.rotation(1, 1)), std::cos(0.12f));
    EXPECT_NEAR(handle.width_m, 0.006f, 0.004f);
    EXPECT_NEAR(handle.position.y(), 0, 0.003f);
  }
}

TEST(RimSearch, AFaceThatWasNotMeasuredMakesNoPlate) {
  // The top of a box gives no depth, as a shiny one does: its front alone looks like a plate.
  RenderedScene box = render(on_table({standing_box(0, 0, {0.12, 0.10, 0.08})}));
  for (std::size_t i = 0; i < box.cloud.size(); ++i)
    if (box.cloud.z[i] > 0.079f) box.cloud.z[i] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(detect_handles(box.cloud, {}, {}).handles.empty());
}

}  // namespace
}  // namespace graspd
