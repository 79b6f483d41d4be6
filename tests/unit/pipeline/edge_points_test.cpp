// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/edge_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "service/pipeline/downsample.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/scene_gallery.hpp"

namespace graspd {
namespace {

/// Definition 1 to the letter, in double precision. Angles within a rounding error of the threshold are
/// counted apart.
struct Count {
  int above = 0, unclear = 0, m = 0;
};

Count count_above(const Normals& normals, std::span<const std::uint32_t> neighborhood, std::size_t s,
                  double theta_high_deg) {
  Count count;
  const Eigen::Vector3d n = normals.at(s).cast<double>();
  for (const std::uint32_t i : neighborhood) {
    ++count.m;
    const Eigen::Vector3d p = normals.at(i).cast<double>();
    // A point without a normal is at no angle to anything: it counts as scattered.
    if (p.isZero()) {
      ++count.above;
      continue;
    }
    const double theta = std::acos(std::clamp(n.dot(p), -1.0, 1.0)) * 180 / std::numbers::pi;
    if (std::abs(theta - theta_high_deg) < 1e-3)
      ++count.unclear;
    else
      count.above += theta > theta_high_deg ? 1 : 0;
  }
  return count;
}

void expect_definition(const PointCloud& cloud, const SmoothnessConfig& config) {
  const Neighborhoods neighborhoods = find_neighborhoods(cloud, {0.009f});
  const Normals normals = estimate_normals(cloud, neighborhoods);
  const std::pmr::vector<std::uint8_t> is_edge = find_edge_points(normals, neighborhoods, config);
  ASSERT_EQ(is_edge.size(), cloud.size());
  std::size_t compared = 0;
  for (std::size_t s = 0; s < cloud.size(); ++s) {
    if (normals.at(s).isZero()) {
      EXPECT_EQ(is_edge[s], 1);
      continue;
    }
    const Count count = count_above(normals, neighborhoods.of(s), s, config.theta_high_deg);
    const bool least = count.above > static_cast<double>(config.edge_share) * count.m;
    const bool most = count.above + count.unclear > static_cast<double>(config.edge_share) * count.m;
    if (least != most) continue;
    ++compared;
    EXPECT_EQ(is_edge[s], least ? 1 : 0) << "point " << s << ": " << count.above << " of " << count.m;
  }
  EXPECT_GT(compared, cloud.size() / 2);
}

TEST(EdgePoints, LiteralCountOfDefinition1) {
  const PointCloud scattered = random_cloud(3000, {0, 0, 0}, {0.08f, 0.08f, 0.03f}, 1);
  const PointCloud box = box_shell({0, 0, 0.5f}, {0.06f, 0.06f, 0.56f}, 0.003f);
  for (const float k : {0.0f, 0.2f, 0.4f, 0.93f})
    for (const float theta_high : {5.0f, 15.0f, 45.0f}) {
      SmoothnessConfig config;
      config.theta_high_deg = theta_high;
      config.edge_share = k;
      expect_definition(scattered, config);
      expect_definition(box, config);
    }
}

TEST(EdgePoints, NoneOnAPlaneAndAllWithoutNormals) {
  const PointCloud plane = grid_patch({0, 0, 1}, {0.003f, 0, 0}, {0, 0.003f, 0}, 30, 30);
  const Neighborhoods near = find_neighborhoods(plane, {0.009f});
  for (const std::uint8_t edge : find_edge_points(estimate_normals(plane, near), near, {}))
    EXPECT_EQ(edge, 0);
  const PointCloud line = grid_patch({0, 0, 1}, {0.003f, 0, 0}, {0, 0, 0}, 30, 1);
  const Neighborhoods along = find_neighborhoods(line, {0.009f});
  for (const std::uint8_t edge : find_edge_points(estimate_normals(line, along), along, {}))
    EXPECT_EQ(edge, 1);
}

TEST(EdgePoints, RunAlongTheEdgesOfABox) {
  const Eigen::Vector3f min(0, 0, 0.5f), max(0.06f, 0.06f, 0.56f);
  const PointCloud box = box_shell(min, max, 0.003f);
  const Neighborhoods near = find_neighborhoods(box, {0.009f});
  const auto is_edge = find_edge_points(estimate_normals(box, near), near, {});
  for (std::size_t i = 0; i < box.size(); ++i) {
    const Eigen::Vector3f p = box.point(i);
    Eigen::Vector3f to_face = (p - min).cwiseMin(max - p).cwiseAbs();
    std::sort(to_face.data(), to_face.data() + 3);
    // The second nearest face is how far the edge is.
    if (to_face[1] < 0.002f) {
      EXPECT_EQ(is_edge[i], 1) << p.transpose();
    }
    if (to_face[1] > 0.0185f) {
      EXPECT_EQ(is_edge[i], 0) << p.transpose();
    }
  }
}

TEST(SmoothnessConfig, ThresholdsInOrder) {
  SmoothnessConfig config;
  EXPECT_FALSE(config.validate());
  config.theta_low_deg = config.theta_high_deg;
  EXPECT_FALSE(config.validate()) << "a single threshold is allowed";
  config.theta_low_deg = config.theta_high_deg + 1;
  ASSERT_TRUE(config.validate());
  EXPECT_EQ(config.validate()->key, "theta_low_deg");
}

}  // namespace
}  // namespace graspd
