// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "service/config/service_config.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/unit/config/config_error_text.hpp"

namespace graspd {
namespace {

constexpr const char* kGripper =
    "aperture_m: 0.1\nfinger_width_m: 0.012\nfinger_thickness_m: 0.02\nfinger_length_m: 0.07\ngrasp_depth_m: "
    "0.03\n"
    "min_gap_m: 0.015\n";

std::string with(const std::string& from, const std::string& to) {
  std::string text = kGripper;
  return text.replace(text.find(from), from.size(), to);
}

std::string error_of(const std::string& text) {
  const TempFolder folder;
  const auto file = folder.write("g.yaml", text);
  return config_error(file, [&] { static_cast<void>(load_gripper(file)); });
}

TEST(GripperFile, ReadsAllLengthsAndTheFilesName) {
  const TempFolder folder;
  const Gripper gripper = load_gripper(folder.write("big_hand.yaml", kGripper));
  EXPECT_EQ(gripper.name, "big_hand");
  EXPECT_EQ(gripper.aperture_m, 0.1f);
  EXPECT_EQ(gripper.finger_width_m, 0.012f);
  EXPECT_EQ(gripper.finger_thickness_m, 0.02f);
  EXPECT_EQ(gripper.finger_length_m, 0.07f);
  EXPECT_EQ(gripper.grasp_depth_m, 0.03f);
  EXPECT_EQ(gripper.min_gap_m, 0.015f);
  EXPECT_EQ(load_gripper(folder.write("x.yaml", std::string("name: y\n") + kGripper)).name, "y");
}

TEST(GripperFile, EveryLengthIsRequired) {
  EXPECT_EQ(error_of(with("grasp_depth_m: 0.03\n", "")),
            "grasp_depth_m: missing (got nothing, expected a value)");
  EXPECT_EQ(error_of(""), "aperture_m: missing (got nothing, expected a value)");
}

TEST(GripperFile, ImpossibleGrippers) {
  EXPECT_EQ(error_of(with("min_gap_m: 0.015", "min_gap_m: 0.012")),
            "min_gap_m: a finger must fit into the gap (got 0.012, expected more than finger_width_m)");
  EXPECT_EQ(error_of(with("grasp_depth_m: 0.03", "grasp_depth_m: 0.07")),
            "grasp_depth_m: the palm would hit the object (got 0.07, expected less than finger_length_m)");
  EXPECT_EQ(error_of(with("aperture_m: 0.1", "aperture_m: 0")),
            "aperture_m: out of range (got 0, expected 0.005 to 0.5)");
  EXPECT_EQ(error_of(with("aperture_m: 0.1", "aperture_m: -0.1")),
            "aperture_m: out of range (got -0.1, expected 0.005 to 0.5)");
}

TEST(GripperFile, MillimetresAreNoticed) {
  EXPECT_EQ(error_of(with("aperture_m: 0.1", "aperture_m: 100")),
            "aperture_m: out of range (got 100, expected 0.005 to 0.5)");
  EXPECT_EQ(error_of(with("aperture_m", "aperture")),
            "aperture: unknown key, did you mean aperture_m? (got aperture, expected aperture_m)");
}

TEST(FindGripper, BesideTheServiceFileBeforeTheInstalledOnes) {
  const TempFolder folder;
  EXPECT_EQ(find_gripper("franka_hand", folder.path()).installed_name, "franka_hand");
  folder.write("grippers/franka_hand.yaml", kGripper);
  const GripperSetting own = find_gripper("franka_hand", folder.path());
  EXPECT_EQ(own.installed_name, "");
  EXPECT_EQ(own.gripper.aperture_m, 0.1f);
}

TEST(FindGripper, ByPath) {
  const TempFolder folder;
  folder.write("hands/h.yaml", kGripper);
  EXPECT_EQ(find_gripper("hands/h.yaml", folder.path()).gripper.name, "h");
  EXPECT_EQ(find_gripper((folder.path() / "hands/h.yaml").string(), "/somewhere/else").gripper.name, "h");
}

TEST(FindGripper, UnknownOnesNameThoseThatThereAre) {
  const TempFolder folder;
  EXPECT_EQ(
      config_error("gripper", [&] { static_cast<void>(find_gripper("hook", folder.path())); }),
      "no such file in grippers/ (got hook, expected franka_hand, paper_80mm, robotiq_2f_140, robotiq_2f_85, "
      "schunk_wsg_50 or a path)");
  EXPECT_EQ(config_error("gripper", [&] { static_cast<void>(find_gripper("hook.yaml", folder.path())); }),
            "no such file (got " + (folder.path() / "hook.yaml").string() + ")");
}

}  // namespace
}  // namespace graspd
