// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/graspable_search.hpp"

#include <gtest/gtest.h>

#include "tests/unit/evaluate/labelled_scene.hpp"

namespace graspd {
namespace {

TEST(GraspableSearch, FindsWhatCanBeHeld) {
  const auto found = find_graspable(LabelScene(labelled(three_objects())), {}, 100);
  ASSERT_EQ(found.size(), 3u);
  for (const GraspableObject& o : found) EXPECT_EQ(o.poses, kMinGraspablePoses) << o.object;
}

TEST(GraspableSearch, WhatIsTooWideCannotBeHeld) {
  const auto found = find_graspable(LabelScene(labelled(too_wide_box())), {}, 100);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].poses, 0);
  Gripper wide;
  wide.aperture_m = 0.14f;
  EXPECT_EQ(find_graspable(LabelScene(labelled(too_wide_box())), wide, 100)[0].poses, kMinGraspablePoses);
}

TEST(GraspableSearch, SmallObjectsAreLeftOut) {
  const LabelScene scene(labelled(box_on_table()));
  EXPECT_TRUE(find_graspable(scene, {}, 1'000'000).empty());
  EXPECT_TRUE(find_graspable(LabelScene{LabelledCloud()}, {}, 1).empty());
}

TEST(GraspableSearch, CsvHasALineAnObject) {
  EXPECT_EQ(graspable_csv_rows("a,b", {{2, 500, 3}, {3, 200, 0}}), "\"a,b\",2,500,3\n\"a,b\",3,200,0\n");
  EXPECT_EQ(graspable_csv_header(), "frame,object,points,poses\n");
}

}  // namespace
}  // namespace graspd
