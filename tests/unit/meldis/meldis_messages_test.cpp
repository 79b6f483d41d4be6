// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/meldis/meldis_messages.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <set>
#include <string>

#include "client/meldis/gripper_mesh.hpp"
#include "service/transport/segmentation_codec.hpp"

namespace graspd {
namespace {

gripper_t small_gripper() {
  gripper_t gripper{};
  gripper.aperture = 0.08;
  gripper.finger_width = 0.01;
  gripper.finger_thickness = 0.02;
  gripper.finger_length = 0.06;
  gripper.grasp_depth = 0.03;
  gripper.min_gap = 0.012;
  return gripper;
}

handle_t handle_at(double x) {
  handle_t handle{};
  handle.position[0] = x;
  handle.orientation[0] = 1;
  handle.width = 0.05;
  return handle;
}

handle_list_t list_of(int n) {
  handle_list_t list{};
  list.gripper = small_gripper();
  for (int i = 0; i < n; ++i) list.handles.push_back(handle_at(i));
  list.num_handles = n;
  return list;
}

TEST(GripperMesh, ThreeBoxesAroundTheObject) {
  TriangleMesh mesh;
  add_gripper(mesh, handle_at(2), small_gripper());
  ASSERT_EQ(mesh.vertices.size(), 24u);
  ASSERT_EQ(mesh.triangles.size(), 36u);
  Eigen::AlignedBox3f all;
  for (const auto& v : mesh.vertices) {
    all.extend(v);
    // Nothing between the jaws in front of the palm.
    if (v.z() > -0.03f + 1e-6f) {
      EXPECT_GE(std::abs(v.y()), 0.025f - 1e-6f);
    }
  }
  EXPECT_TRUE(all.min().isApprox(Eigen::Vector3f(1.99f, -0.05f, -0.04f), 1e-5f)) << all.min().transpose();
  EXPECT_TRUE(all.max().isApprox(Eigen::Vector3f(2.01f, 0.05f, 0.03f), 1e-5f)) << all.max().transpose();
}

/// Of a closed mesh with outward triangles: its volume.
TEST(GripperMesh, TrianglesFaceOutwards) {
  TriangleMesh mesh;
  add_gripper(mesh, handle_at(0), small_gripper());
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](int i) {
      return mesh.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(i)])];
    };
    volume += static_cast<double>(at(0).dot(at(1).cross(at(2)))) / 6;
  }
  EXPECT_NEAR(volume, 2 * (0.01 * 0.02 * 0.06) + 0.1 * 0.02 * 0.01, 1e-8);
}

TEST(GripperMesh, TurnsWithTheHandle) {
  handle_t handle = handle_at(0);
  handle.orientation[0] = handle.orientation[1] = std::sqrt(0.5);  // 90 degrees about x: y becomes z
  TriangleMesh mesh;
  add_gripper(mesh, handle, small_gripper());
  Eigen::AlignedBox3f all;
  for (const auto& v : mesh.vertices) all.extend(v);
  EXPECT_NEAR(all.max().z(), 0.05f, 1e-6f);
  EXPECT_NEAR(all.min().y(), -0.03f, 1e-6f);
}

TEST(MeldisMessages, FramesOfTheBest) {
  const auto draw = handle_frames(list_of(7), 5);
  EXPECT_EQ(draw.num_links, 5);
  ASSERT_EQ(draw.link_name.size(), 5u);
  EXPECT_EQ(draw.link_name[4], "handle_4");
  EXPECT_EQ(draw.position[4], (std::vector<float>{4, 0, 0}));
  EXPECT_EQ(draw.quaternion[4], (std::vector<float>{1, 0, 0, 0}));
  EXPECT_EQ(handle_frames(list_of(0), 5).num_links, 0);
}

TEST(MeldisMessages, GrippersReplaceThoseOfTheLastList) {
  for (const int n : {0, 1, 3}) {
    const auto link = handle_grippers(list_of(n), 5);
    ASSERT_EQ(link.geom.size(), 2u);
    const int boxes[] = {n > 0 ? 3 : 0, n > 1 ? 3 * (n - 1) : 0};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& data = link.geom[i].float_data;
      ASSERT_GE(data.size(), 2u);
      EXPECT_EQ(data[1], boxes[i] > 0 ? static_cast<float>(12 * boxes[i]) : 1);
      EXPECT_EQ(static_cast<float>(data.size()), 2 + 3 * data[0] + 3 * data[1]);
      for (std::size_t k = data.size() - static_cast<std::size_t>(3 * data[1]); k < data.size(); ++k)
        EXPECT_LT(data[k], data[0]);
    }
  }
}

TEST(MeldisMessages, CloudAsMeldisWantsIt) {
  segmentation_t segmentation{};
  segmentation.step = 0.001;
  segmentation.origin[2] = 1;
  segmentation.num_points = 4;
  // x, y, z, segment, flags: two segments, an edge point, one of the support
  const std::uint16_t points[4][5] = {{1, 2, 3, 0, 0}, {4, 5, 6, 1, 0}, {7, 8, 9, 0, 1}, {1, 1, 1, 65535, 2}};
  segmentation.data.resize(sizeof points);
  std::memcpy(segmentation.data.data(), points, sizeof points);
  segmentation.data_size = sizeof points;
  const auto cloud = coloured_cloud(segmentation);
  EXPECT_EQ(cloud.flags, 2);
  EXPECT_EQ(cloud.height, 1);
  EXPECT_EQ(cloud.width, 4);
  EXPECT_EQ(cloud.point_step, 16);
  EXPECT_EQ(cloud.data_size, 64);
  ASSERT_EQ(cloud.data.size(), 64u);
  ASSERT_EQ(cloud.fields.size(), 4u);
  EXPECT_EQ(cloud.fields[3].name, "rgb");
  std::set<std::uint32_t> colors;
  for (std::size_t i = 0; i < 4; ++i) {
    float xyz[3];
    std::uint32_t rgb = 0;
    std::memcpy(xyz, &cloud.data[16 * i], 12);
    std::memcpy(&rgb, &cloud.data[16 * i + 12], 4);
    EXPECT_FLOAT_EQ(xyz[0], 0.001f * points[i][0]);
    EXPECT_FLOAT_EQ(xyz[2], 1 + 0.001f * points[i][2]);
    EXPECT_EQ(rgb >> 24, 0u);
    colors.insert(rgb);
  }
  EXPECT_EQ(colors.size(), 4u);
}

TEST(MeldisMessages, FingerprintsAreDrakes) {
  EXPECT_EQ(static_cast<std::uint64_t>(drake::lcmt_viewer_draw::getHash()), 0x414f0bfe5b2f4244u);
  EXPECT_EQ(static_cast<std::uint64_t>(drake::lcmt_point_cloud::getHash()), 0x17f2c128b5d25a95u);
}

}  // namespace
}  // namespace graspd
