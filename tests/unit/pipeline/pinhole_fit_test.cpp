// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/pinhole_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "service/pipeline/workspace_filter.hpp"
#include "tests/support/clouds.hpp"

namespace graspd {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// A wavy surface as a camera at the origin sees it, organized.
PointCloud image_of(int width, int height, const PinholeModel& camera) {
  PointCloud cloud;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const auto column = static_cast<float>(u), row = static_cast<float>(v);
      const float z = 0.8f + 0.1f * std::sin(0.2f * column) + 0.002f * row;
      cloud.push_back(
          {(column - camera.cx_px) / camera.fx_px * z, (row - camera.cy_px) / camera.fy_px * z, z});
    }
  cloud.width = width;
  cloud.height = height;
  return cloud;
}

std::optional<PinholeModel> fit(const PointCloud& cloud) {
  const WorkspaceResult kept = filter_workspace(cloud, {});
  return fit_pinhole(kept.cloud, kept.pixels);
}

void expect_model(const std::optional<PinholeModel>& found, const PinholeModel& expected) {
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->fx_px, expected.fx_px, 0.01f);
  EXPECT_NEAR(found->fy_px, expected.fy_px, 0.01f);
  EXPECT_NEAR(found->cx_px, expected.cx_px, 0.01f);
  EXPECT_NEAR(found->cy_px, expected.cy_px, 0.01f);
}

void make_missing(PointCloud& cloud, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) cloud.x[i] = cloud.y[i] = cloud.z[i] = kNan;
}

TEST(PinholeFit, FindsTheFourNumbers) {
  for (const PinholeModel camera : {PinholeModel{180, 180, 79.5f, 59.5f}, PinholeModel{150, 300, 70, 65},
                                    PinholeModel{400, 200, -30, 200}})
    expect_model(fit(image_of(160, 120, camera)), camera);
}

TEST(PinholeFit, MissingPointsAndRowsTakeNoPart) {
  const PinholeModel camera{180, 200, 79.5f, 59.5f};
  PointCloud cloud = image_of(160, 120, camera);
  make_missing(cloud, 0, 20 * 160);
  make_missing(cloud, 50 * 160 + 7, 51 * 160);
  for (std::size_t i = 3; i < cloud.size(); i += 5) make_missing(cloud, i, i + 1);
  expect_model(fit(cloud), camera);
}

TEST(PinholeFit, PartOfAnImageHasAnotherCentre) {
  const PointCloud whole = image_of(160, 120, {180, 200, 79.5f, 59.5f});
  PointCloud part;
  part.width = 50;
  part.height = 40;
  for (std::size_t v = 10; v < 50; ++v)
    for (std::size_t u = 90; u < 140; ++u) part.push_back(whole.point(v * 160 + u));
  expect_model(fit(part), {180, 200, -10.5f, 49.5f});
}

TEST(PinholeFit, TheViewpointIsThePinhole) {
  PointCloud cloud = image_of(160, 120, {180, 180, 79.5f, 59.5f});
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.translation() = Eigen::Vector3f(1, -2, 3);
  expect_model(fit(moved(cloud, T)), {180, 180, 79.5f, 59.5f});
  cloud.viewpoint = {0.1f, 0, 0};
  EXPECT_FALSE(fit(cloud));
}

TEST(PinholeFit, NoneForOtherFramesAndOtherLenses) {
  const PointCloud cloud = image_of(160, 120, {180, 180, 79.5f, 59.5f});
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.linear() = Eigen::AngleAxisf(0.1f, Eigen::Vector3f::UnitX()).toRotationMatrix();
  EXPECT_FALSE(fit(moved(cloud, T)));
  T.linear() = Eigen::AngleAxisf(3.14159265f, Eigen::Vector3f::UnitX()).toRotationMatrix();
  EXPECT_FALSE(fit(moved(cloud, T))) << "the camera looks the other way";

  PointCloud distorted = cloud, mirrored = cloud, shifted = cloud;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float u = cloud.x[i] / cloud.z[i], v = cloud.y[i] / cloud.z[i], factor = 1 + 0.3f * (u * u + v * v);
    distorted.x[i] *= factor;
    distorted.y[i] *= factor;
    mirrored.x[i] *= -1;
    shifted.x[i] += i % 2 == 0 ? 0.005f : -0.005f;
  }
  EXPECT_FALSE(fit(distorted));
  EXPECT_FALSE(fit(mirrored));
  EXPECT_FALSE(fit(shifted)) << "more than half a pixel";
}

TEST(PinholeFit, NoneWithoutAnImageOrWithTooLittleOfIt) {
  PointCloud cloud = image_of(160, 120, {180, 180, 79.5f, 59.5f});
  PointCloud list = cloud;
  list.width = 160 * 120;
  list.height = 1;
  EXPECT_FALSE(fit(list));
  PointCloud row = cloud, column = cloud;
  make_missing(row, 160, row.size());
  EXPECT_FALSE(fit(row)) << "nothing is known of fy";
  for (std::size_t i = 0; i < column.size(); ++i)
    if (i % 160 != 80) make_missing(column, i, i + 1);
  EXPECT_FALSE(fit(column)) << "nothing is known of fx";
  make_missing(cloud, 0, cloud.size());
  EXPECT_FALSE(fit(cloud));
}

TEST(PinholeFit, NoneForSizesThatAreNotTheClouds) {
  const PointCloud cloud = image_of(160, 120, {180, 180, 79.5f, 59.5f});
  const WorkspaceResult kept = filter_workspace(cloud, {});
  for (const auto& [width, height] : {std::pair{0, 0}, {-160, -120}, {1, 19200}, {19200, 1}, {0, 120}}) {
    EXPECT_FALSE(fit_pinhole(kept.cloud, {width, height, kept.pixels.of_point})) << width << " x " << height;
  }
  EXPECT_FALSE(fit_pinhole(kept.cloud, {160, 120, {}}));
  EXPECT_FALSE(fit_pinhole({}, {160, 120, {}}));
  for (const auto& [width, height] :
       {std::pair{161, 120}, {-160, -120}, {65536, 65536}, {std::numeric_limits<int>::max(), 2}}) {
    PointCloud odd = cloud;
    odd.width = width;
    odd.height = height;
    EXPECT_TRUE(filter_workspace(odd, {}).pixels.of_point.empty()) << width << " x " << height;
  }
}

}  // namespace
}  // namespace graspd
