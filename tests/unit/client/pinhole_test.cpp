// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/pinhole.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "client/simulate/depth_camera.hpp"
#include "client/simulate/sensor_noise.hpp"
#include "client/simulate/simulation.hpp"

namespace graspd {
namespace {

LabelledCloud image(const Pinhole& camera, const char* sensor = "kinect") {
  SimulationConfig config;
  config.camera = camera;
  config.sensor = *sensor_model(sensor);
  return to_cloud(Simulation(config).frame(0));
}

std::string problem(const PointCloud& cloud) {
  const auto fit = estimate_pinhole(cloud);
  return std::holds_alternative<std::string>(fit) ? std::get<std::string>(fit) : "";
}

TEST(Pinhole, IsFoundAgain) {
  for (const Pinhole& camera : {Pinhole{}, Pinhole{320, 240, 290.5, 288.25, 155.125, 122.75}}) {
    const auto fit = std::get<Pinhole>(estimate_pinhole(image(camera).cloud));
    EXPECT_EQ(fit.width, camera.width);
    EXPECT_EQ(fit.height, camera.height);
    EXPECT_NEAR(fit.fx, camera.fx, 1e-2);
    EXPECT_NEAR(fit.fy, camera.fy, 1e-2);
    EXPECT_NEAR(fit.cx, camera.cx, 1e-2);
    EXPECT_NEAR(fit.cy, camera.cy, 1e-2);
  }
}

TEST(Pinhole, OtherCloudsAreRefusedWithTheReason) {
  PointCloud cloud = image(Pinhole{}).cloud;
  EXPECT_EQ(problem(cloud), "");
  PointCloud line = cloud;
  line.width = static_cast<int>(line.size());
  line.height = 1;
  EXPECT_EQ(problem(line), "not organized: a depth image needs rows and columns");
  PointCloud seen_from_elsewhere = cloud;
  seen_from_elsewhere.viewpoint.x() = 1;
  EXPECT_EQ(problem(seen_from_elsewhere), "its viewpoint is not the origin, as it is in an optical frame");
  PointCloud mirrored = cloud;
  for (float& x : mirrored.x) x = -x;
  EXPECT_EQ(problem(mirrored), "not in an optical frame: x does not grow along the image");
  PointCloud behind = cloud;
  for (float& z : behind.z) z = -z;
  EXPECT_EQ(problem(behind), "not in an optical frame: points lie behind the camera");
  PointCloud shifted = cloud;
  for (float& x : shifted.x) x += 0.02f;
  EXPECT_NE(problem(shifted).find("not a pinhole image"), std::string::npos);
  PointCloud empty = cloud;
  for (float& z : empty.z) z = std::nanf("");
  EXPECT_EQ(problem(empty), "too few points: 0, expected 100");
}

TEST(DepthUnits, RoundAndMarkWhatIsMissing) {
  const std::vector<float> z{0.8f, 0.80049f, 0.8006f, 0.0f, -1.0f, std::nanf(""), INFINITY, 65.535f, 65.54f};
  const std::vector<std::uint16_t> expected{800, 800, 801, 0, 0, 0, 0, 65535, 0};
  EXPECT_EQ(depth_units(z, 0.001), expected);
}

}  // namespace
}  // namespace graspd
