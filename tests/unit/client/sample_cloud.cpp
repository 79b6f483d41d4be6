// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/client/sample_cloud.hpp"

#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <limits>

#include "client/common/pcd_reader.hpp"
#include "client/common/ply_reader.hpp"
#include "client/simulate/rng.hpp"

namespace graspd {

LabelledCloud sample_cloud() {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  LabelledCloud labelled;
  labelled.cloud.width = 8;
  labelled.cloud.height = 6;
  labelled.cloud.viewpoint = {0.125f, -0.5f, 1.75f};
  Rng rng(1);
  for (std::uint32_t i = 0; i < 48; ++i) {
    const auto value = [&] { return static_cast<float>(rng.uniform(-1, 1)); };
    const bool hole = i == 5 || i == 17;
    labelled.cloud.push_back(hole ? Eigen::Vector3f(nan, nan, nan)
                                  : Eigen::Vector3f(value(), value(), value()));
    labelled.rgb.push_back(0x102030 + i * 0x010203);
    labelled.label.push_back(10 * (i % 5));
  }
  return labelled;
}

pcl::PointCloud<pcl::PointXYZRGBL> pcl_sample_cloud() {
  const LabelledCloud labelled = sample_cloud();
  pcl::PointCloud<pcl::PointXYZRGBL> cloud(8, 6);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    auto& p = cloud[i];
    p.x = labelled.cloud.x[i];
    p.y = labelled.cloud.y[i];
    p.z = labelled.cloud.z[i];
    p.rgba = labelled.rgb[i];
    p.label = labelled.label[i];
  }
  cloud.sensor_origin_ = {0.125f, -0.5f, 1.75f, 0};
  return cloud;
}

std::string parse_failure(const std::string& bytes) {
  try {
    (void)(bytes.starts_with("ply") ? parse_ply(bytes) : parse_pcd(bytes));
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()).find_first_of("\n\x1b"), std::string::npos) << error.what();
    return error.what();
  }
  return "loaded";
}

}  // namespace graspd
