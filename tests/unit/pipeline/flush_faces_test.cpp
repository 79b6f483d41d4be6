// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/flush_faces.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/clouds.hpp"

namespace graspd {
namespace {

constexpr float kSpacing = 0.003f;

/// An upright face in y = 0 over x from 0 to 80 mm, and tops behind it over both of its halves.
struct Row {
  PointCloud cloud;
  Segments segments;

  /// apart_m: by how much the second top begins after the first one ends, along the face.
  Row(float step_m, float apart_m) {
    cloud = grid_patch({0, 0, -0.05f}, {kSpacing, 0, 0}, {0, 0, kSpacing}, 28, 16);
    Labels labels{std::pmr::vector<std::int32_t>(cloud.size(), 0), 3};
    for (const int top : {1, 2}) {
      const Eigen::Vector3f corner =
          top == 1 ? Eigen::Vector3f(0, 0.003f, 0) : Eigen::Vector3f(0.042f + apart_m, 0.003f, step_m);
      cloud = joined(cloud, grid_patch(corner, {kSpacing, 0, 0}, {0, kSpacing, 0}, 14, 20));
      labels.of_point.resize(cloud.size(), top);
    }
    cloud.viewpoint = {0, -1, 1};
    segments = build_segments(cloud, labels, kSpacing, {});
  }
  [[nodiscard]] std::pmr::vector<FlushFace> find() const {
    constexpr std::array<std::pair<std::int32_t, std::int32_t>, 2> kConvex{{{0, 1}, {0, 2}}};
    return find_flush_faces(cloud, segments, kConvex);
  }
};

TEST(FlushFaces, NoneAmongNothing) {
  EXPECT_TRUE(find_flush_faces({}, {}, {}).empty());
}

TEST(FlushFaces, AFaceUnderTwoHeightsIsOfTwoThings) {
  const auto faces = Row(0.03f, 0).find();
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].segment, 0);
  EXPECT_EQ(faces[0].part_at({0.01f, 0, -0.02f}).segment, 1);
  EXPECT_EQ(faces[0].part_at({0.07f, 0, -0.02f}).segment, 2);
}

TEST(FlushFaces, OneHeightIsOneThing) {
  EXPECT_TRUE(Row(0, 0).find().empty());
  EXPECT_TRUE(Row(0.003f, 0).find().empty()) << "no more than noise and a lean";
}

TEST(FlushFaces, ALidOverItsShoulderIsNotBesideIt) {
  EXPECT_TRUE(Row(0.03f, -0.03f).find().empty());
}

}  // namespace
}  // namespace graspd
