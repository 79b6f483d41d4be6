// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/support_check.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/scene_gallery.hpp"
#include "tests/unit/pipeline/check_scene.hpp"

namespace graspd {
namespace {

/// Two boards, the upper one at 0.32 m, and a gripper of which it is asked whether it stays clear of them.
class SupportCheckTest : public testing::Test {
 protected:
  /// level: of what is held, 0 or 1; the jaws close along x.
  [[nodiscard]] bool is_clear(std::uint32_t level, const Eigen::Vector3f& position,
                              const Eigen::Vector3f& approach) const {
    const std::vector<std::uint32_t> levels{level};
    SceneView view = scene_.view();
    view.level_of_object = levels;
    Handle handle;
    handle.position = position;
    handle.rotation << Eigen::Vector3f::UnitX().cross(approach), Eigen::Vector3f::UnitX(), approach;
    return is_clear_of_support(view, {}, {}, handle, 0.035f, 0);
  }

  const CheckScene scene_{shelf()};
};

const Eigen::Vector3f kDown(0, 0, -1), kInward(0, 1, 0);

TEST_F(SupportCheckTest, TheSceneHasTwoLevels) {
  ASSERT_TRUE(scene_.view().support);
  EXPECT_EQ(scene_.view().support->levels.size(), 2u);
}

TEST_F(SupportCheckTest, TheFingertipsStayAboveWhatTheObjectStandsOn) {
  EXPECT_TRUE(is_clear(0, {0, -0.05f, 0.08f}, kInward));
  EXPECT_FALSE(is_clear(0, {0, -0.05f, 0.005f}, kInward));
  EXPECT_TRUE(is_clear(1, {0, 0, 0.40f}, kDown));
  EXPECT_FALSE(is_clear(1, {0, 0, 0.33f}, kDown)) << "fingertips in the board";
  EXPECT_FALSE(is_clear(1, {0, -0.05f, 0.25f}, kInward)) << "below it";
}

TEST_F(SupportCheckTest, NoPartOfTheHandGoesThroughAnotherLevel) {
  EXPECT_FALSE(is_clear(0, {0, 0, 0.25f}, kDown)) << "from above through the upper board";
  EXPECT_TRUE(is_clear(0, {0, -0.3f, 0.25f}, kDown)) << "before the shelf";
  EXPECT_TRUE(is_clear(0, {0.6f, 0, 0.25f}, kDown)) << "beside it";
  EXPECT_TRUE(is_clear(0, {0, -0.05f, 0.25f}, kInward)) << "between the boards";
  EXPECT_FALSE(is_clear(0, {0, -0.1f, 0.316f}, kInward))
      << "an edge of the fingers reaches up into the board";
}

}  // namespace
}  // namespace graspd
