// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/handle_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "tests/support/scene_gallery.hpp"
#include "tests/unit/pipeline/check_scene.hpp"

namespace graspd {
namespace {

TEST(Failure, NamesAreDistinctAndLowerSnake) {
  std::set<std::string> names;
  for (std::size_t i = 0; i <= kNumFailures; ++i) {
    const std::string text(name(static_cast<Failure>(i)));
    EXPECT_TRUE(std::regex_match(text, std::regex("[a-z]+(_[a-z]+)*"))) << text;
    EXPECT_TRUE(names.insert(text).second) << text;
  }
  EXPECT_EQ(name(Failure::kTooWide), "too_wide");
  EXPECT_EQ(name(Failure::kNone), "none");
}

/// The keys and ranges of the limits that are angles.
struct AngleRanges {
  std::map<std::string, Range> ranges;
  template <class T>
  void operator()(const char* key, const T&, const Range& range, const char*) {
    if (std::string(key).ends_with("_deg")) ranges[key] = range;
  }
};

struct AngleSetter {
  std::string key;
  float value;
  template <class T>
  void operator()(const char* name, T& field, const Range&, const char*) {
    if (key == name) field = static_cast<T>(value);
  }
};

TEST(HandleCheck, EveryLimitOfAnAngleMayBeAtEitherEndOfItsRange) {
  const CheckScene scene(box_on_table());
  const Candidate candidate =
      scene.candidate({0, 0, 0.08f}, -Eigen::Vector3f::UnitZ(), Eigen::Vector3f::UnitX());
  CheckBuffers buffers;
  ASSERT_EQ(check_candidate(scene.view(), {}, {}, candidate, buffers).failure, Failure::kNone);
  AngleRanges angles;
  const HandleCheckConfig usual;
  HandleCheckConfig::visit(usual, angles);
  EXPECT_GE(angles.ranges.size(), 4u);
  for (const auto& [key, range] : angles.ranges) {
    SCOPED_TRACE(key);
    HandleCheckConfig config;
    HandleCheckConfig::visit(config, AngleSetter{key, static_cast<float>(range.max)});
    const CheckResult loose = check_candidate(scene.view(), {}, config, candidate, buffers);
    EXPECT_EQ(loose.failure, Failure::kNone) << "what passes the usual limit passes a wider one";
    EXPECT_TRUE(std::isfinite(score(loose.margins)));
    HandleCheckConfig::visit(config, AngleSetter{key, static_cast<float>(range.min)});
    const CheckResult strict = check_candidate(scene.view(), {}, config, candidate, buffers);
    EXPECT_TRUE(strict.failure != Failure::kNone || std::isfinite(score(strict.margins)));
  }
}

TEST(HandleCheck, TheFingertipsGoNoDeeperThanTheCandidateSays) {
  const CheckScene scene(box_on_table());
  const Gripper gripper;
  CheckBuffers buffers;
  Candidate candidate = scene.candidate({0, 0, 0.08f}, -Eigen::Vector3f::UnitZ(), Eigen::Vector3f::UnitX());
  for (const float depth_m : {0.014f, 0.020f, gripper.grasp_depth_m, 1.0f}) {
    candidate.depth_m = depth_m;
    const CheckResult result = check_candidate(scene.view(), gripper, {}, candidate, buffers);
    ASSERT_EQ(result.failure, Failure::kNone);
    EXPECT_NEAR(result.handle.position.z() - gripper.grasp_depth_m,
                0.08f - std::min(depth_m, gripper.grasp_depth_m), 0.003f);
  }
}

TEST(HandleCheck, ABoxIsHeldAcrossItsNarrowSideOnly) {
  const CheckScene scene(box_on_table());
  CheckBuffers buffers;
  const auto check = [&](const Eigen::Vector3f& closing) {
    return check_candidate(scene.view(), {}, {},
                           scene.candidate({0, 0, 0.08f}, -Eigen::Vector3f::UnitZ(), closing), buffers);
  };
  const CheckResult across = check(Eigen::Vector3f::UnitX());
  ASSERT_EQ(across.failure, Failure::kNone);
  EXPECT_NEAR(across.handle.width_m, 0.05f, 0.003f);
  EXPECT_GT(std::abs(across.squared_axis.x()), 0.99f) << "square to the sides already";
  EXPECT_EQ(check(Eigen::Vector3f::UnitY()).failure, Failure::kTooWide) << "120 mm";
}

TEST(HandleCheck, JawsThatEndShortOfTheWidestPlaceOfARoundThingAreDoubted) {
  const CheckScene scene(on_table({standing_cylinder(0, 0, 0.036, 0.12)}));
  CheckBuffers buffers;
  const auto grip = [&](const Eigen::Vector3f& position, const Eigen::Vector3f& approach, float depth_m) {
    Candidate candidate = scene.candidate(position, approach, Eigen::Vector3f::UnitX());
    candidate.depth_m = depth_m;
    const CheckResult result = check_candidate(scene.view(), {}, {}, candidate, buffers);
    EXPECT_EQ(result.failure, Failure::kNone);
    return result.margins.grip;
  };
  // From the front and above the fingertips go 21 or 25 mm level into a thing whose middle is at 36 mm.
  const Eigen::Vector3f front(0, -0.036f, 0.08f), inclined = Eigen::Vector3f(0, 0.82f, -0.57f).normalized();
  const float short_of_it = grip(front, inclined, 0.026f), nearer = grip(front, inclined, 0.030f);
  EXPECT_LT(short_of_it, 0.1f);
  EXPECT_GT(nearer, short_of_it);
  EXPECT_LT(nearer, 0.5f);
  EXPECT_GE(grip({0, 0, 0.12f}, -Eigen::Vector3f::UnitZ(), 0.030f), 1) << "around the whole of it";
  // Level, where the profile is a circle: 14 mm short of its middle the walls lean by 23 degrees, of 18
  // to 27.
  const Eigen::Vector3f level = Eigen::Vector3f::UnitY();
  EXPECT_NEAR(grip(front, level, 0.022f), 0.46f, 0.2f);
  EXPECT_GE(grip(front, level, 0.030f), 1);
}

TEST(HandleCheck, TheHandDoesNotComeThroughWhatOthersHide) {
  const AnalyticSolid low = standing_box(0, 0, {0.05, 0.12, 0.06});
  // Hangs between the sensor and where the palm comes down; the box and the fingers are seen below it.
  const AnalyticSolid curtain = standing_box(0, -0.25, {0.3, 0.02, 0.1});
  const auto check = [&](double height_m) {
    AnalyticSolid hung = curtain;
    hung.T_scene_solid.translation().z() += height_m;
    const CheckScene scene(on_table({low, hung}));
    CheckBuffers buffers;
    return check_candidate(
               scene.view(), {}, {},
               scene.candidate({0, 0, 0.06f}, -Eigen::Vector3f::UnitZ(), Eigen::Vector3f::UnitX()), buffers)
        .failure;
  };
  EXPECT_EQ(check(0.37), Failure::kUnseen) << "hides what is 0.16 m above the table, and more";
  EXPECT_EQ(check(0.45), Failure::kNone);
}

TEST(HandleCheck, HalfOfAFingerOnTheEndOfABoxIsEnough) {
  const Gripper gripper;
  const CheckScene scene(box_on_table());
  constexpr float kEnd = -0.06f;
  CheckBuffers buffers;
  const auto check = [&](float on_the_box) {
    const float y = kEnd + on_the_box - 0.5f * gripper.finger_thickness_m;
    return check_candidate(
        scene.view(), gripper, {},
        scene.candidate({0, y, 0.08f}, -Eigen::Vector3f::UnitZ(), Eigen::Vector3f::UnitX()), buffers);
  };
  const CheckResult on_half = check(0.5f * gripper.finger_thickness_m);
  EXPECT_EQ(on_half.failure, Failure::kNone);
  EXPECT_NEAR(on_half.handle.width_m, 0.05f, 0.003f);
  EXPECT_EQ(check(0.3f * gripper.finger_thickness_m).failure, Failure::kSilhouettes);
}

}  // namespace
}  // namespace graspd
