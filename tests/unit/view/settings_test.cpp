// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/view/settings.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

class ViewSettingsTest : public testing::Test {
 protected:
  Settings settings_{""};
};

TEST_F(ViewSettingsTest, ACommandBecomesOverridesThatTheDaemonReads) {
  SetCommand command;
  command.source = "camera";
  command.theta_low_deg = 7;
  command.leaf_size_m = 0.004;
  ASSERT_FALSE(settings_.problem(command));
  // The daemon's own way: merged with what there is, then read with everything checked.
  ASSERT_TRUE(settings_.use_overrides(merge_overrides("", settings_.yaml(command))));
  const DetectConfig& detect = settings_.config().sources.at(0).detect;
  EXPECT_FLOAT_EQ(detect.smoothness.theta_low_deg, 7);
  EXPECT_FLOAT_EQ(detect.downsample.leaf_size_m, 0.004f);
  EXPECT_FLOAT_EQ(detect.neighborhoods.radius_m, 0.012f) << "reaches as many voxels as before";
  EXPECT_FLOAT_EQ(detect.smoothness.theta_high_deg, 15) << "what was not named stays";
  EXPECT_EQ(nlohmann::json::parse(settings_.json(true)).at("sources").at(0).at("theta_low_deg"), 7.0);
  EXPECT_TRUE(settings_.use_overrides("")) << "taken back";
  EXPECT_FLOAT_EQ(settings_.config().sources.at(0).detect.smoothness.theta_low_deg, 4);
}

TEST_F(ViewSettingsTest, NamesThatAreNotThereAreRefused) {
  SetCommand command;
  command.source = "nobody";
  EXPECT_TRUE(settings_.problem(command));
  command.source = "camera";
  command.gripper = "../../etc/passwd";
  EXPECT_TRUE(settings_.problem(command));
  command.gripper = "franka_hand";
  EXPECT_FALSE(settings_.problem(command));
  EXPECT_TRUE(settings_.use_overrides(settings_.yaml(command)));
  EXPECT_EQ(settings_.config().sources.at(0).gripper.gripper.name, "franka_hand");
}

TEST_F(ViewSettingsTest, OverridesOfAnotherDaemonChangeNothing) {
  EXPECT_FALSE(settings_.use_overrides("no_such_key: 1"));
  EXPECT_FALSE(settings_.use_overrides("{{{"));
  EXPECT_FLOAT_EQ(settings_.config().sources.at(0).detect.smoothness.theta_low_deg, 4);
}

TEST(ViewSettings, KnowWhereTheSensorIs) {
  const TempFolder folder;
  const auto file = folder.write("graspd.yaml", R"(
sources:
  - name: table
    channel: TABLE_.*
    sensor_pose: {frame_name: base, position_m: [1, 2, 3]}
)");
  const Settings settings(file.string());
  EXPECT_EQ(settings.T_target_cloud("TABLE_CAMERA").translation(), Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(settings.T_target_cloud("OTHER").translation(), Eigen::Vector3f::Zero());
}

}  // namespace
}  // namespace graspd
