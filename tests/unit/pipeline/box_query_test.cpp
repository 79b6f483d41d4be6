// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/box_query.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "tests/support/clouds.hpp"

namespace graspd {
namespace {

struct QueryBox {
  Eigen::Vector3f origin, min, max;
  Eigen::Matrix3f rotation;
};

QueryBox random_box(std::mt19937& random, float reach_m, float edge_m) {
  std::uniform_real_distribution<float> unit(-1, 1);
  const auto vector = [&](float scale) {
    const float x = unit(random), y = unit(random), z = unit(random);
    return Eigen::Vector3f(scale * x, scale * y, scale * z);
  };
  QueryBox box;
  box.origin = vector(reach_m);
  const Eigen::Vector3f a = vector(edge_m), b = vector(edge_m);
  box.min = a.cwiseMin(b);
  box.max = a.cwiseMax(b);
  box.rotation = Eigen::Quaternionf(unit(random), unit(random), unit(random), unit(random))
                     .normalized()
                     .toRotationMatrix();
  return box;
}

/// Every point by its own, in double precision. Those within a rounding error of a face may be in or out.
void expect_brute_force(const PointCloud& cloud, const BoxQuery& query, const QueryBox& box) {
  constexpr double kRounding = 1e-6;
  LocalPoints found;
  query.find(box.origin, box.rotation, box.min, box.max, found);
  ASSERT_EQ(found.f.size(), found.size());
  ASSERT_EQ(found.z.size(), found.size());
  ASSERT_EQ(found.index.size(), found.size());
  std::map<std::uint32_t, std::size_t> position;
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_TRUE(position.emplace(found.index[k], k).second) << "point " << found.index[k] << " twice";
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d q =
        box.rotation.cast<double>().transpose() * (cloud.point(i) - box.origin).cast<double>();
    const double inside =
        std::min((q - box.min.cast<double>()).minCoeff(), (box.max.cast<double>() - q).minCoeff());
    const auto at = position.find(i);
    if (inside > kRounding) {
      EXPECT_TRUE(at != position.end()) << "point " << i << ", " << inside << " m inside";
    }
    if (inside < -kRounding) {
      EXPECT_TRUE(at == position.end()) << "point " << i << ", " << -inside << " m outside";
    }
    if (at == position.end()) continue;
    const Eigen::Vector3f local(found.a[at->second], found.f[at->second], found.z[at->second]);
    EXPECT_LT((local.cast<double>() - q).norm(), kRounding);
  }
}

TEST(BoxQuery, EmptyCloudAndDefault) {
  LocalPoints found;
  const QueryBox box{{0, 0, 0}, {-1, -1, -1}, {1, 1, 1}, Eigen::Matrix3f::Identity()};
  BoxQuery().find(box.origin, box.rotation, box.min, box.max, found);
  EXPECT_EQ(found.size(), 0u);
  BoxQuery(PointCloud{}, 0.02f).find(box.origin, box.rotation, box.min, box.max, found);
  EXPECT_EQ(found.size(), 0u);
}

TEST(BoxQuery, RandomOrientedBoxes) {
  const PointCloud cloud = random_cloud(2000, {-0.2f, -0.15f, -0.1f}, {0.2f, 0.15f, 0.1f}, 1);
  const BoxQuery query(cloud, 0.02f);
  std::mt19937 random(2);
  for (int k = 0; k < 300; ++k) expect_brute_force(cloud, query, random_box(random, 0.2f, 0.12f));
}

TEST(BoxQuery, BoxesThatReachBeyondTheGrid) {
  const PointCloud cloud = random_cloud(1500, {0.3f, -0.6f, 0.9f}, {0.4f, -0.4f, 1.0f}, 3);
  const BoxQuery query(cloud, 0.02f);
  std::mt19937 random(4);
  for (int k = 0; k < 200; ++k) {
    QueryBox box = random_box(random, 0.15f, 0.5f);
    box.origin += Eigen::Vector3f(0.35f, -0.5f, 0.95f);
    expect_brute_force(cloud, query, box);
  }
  for (const Eigen::Vector3f& away :
       {Eigen::Vector3f(3, 0, 0), Eigen::Vector3f(0, -3, 0), Eigen::Vector3f(0, 0, 3)}) {
    QueryBox box = random_box(random, 0.1f, 0.2f);
    box.origin += away;
    expect_brute_force(cloud, query, box);
  }
}

TEST(BoxQuery, FacesOnCellBorders) {
  const PointCloud cloud = grid_patch({-0.1f, -0.1f, 0.5f}, {0.01f, 0, 0}, {0, 0.01f, 0}, 21, 21);
  const BoxQuery query(cloud, 0.02f);
  for (int i = -12; i <= 12; ++i)
    for (int j = 0; j < 6; ++j) {
      const float lo = 0.01f * static_cast<float>(i), hi = lo + 0.01f * static_cast<float>(j);
      // As far as rounding allows a tie, the face itself belongs to the box.
      const float slack = 2e-6f;
      expect_brute_force(
          cloud, query,
          {{0, 0, 0.5f}, {lo - slack, -1, -0.001f}, {hi + slack, 1, 0.001f}, Eigen::Matrix3f::Identity()});
    }
}

TEST(BoxQuery, ThinBoxesAndCellsOfAllSizes) {
  const PointCloud cloud = random_cloud(1000, {-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}, 5);
  std::mt19937 random(6);
  for (const float cell : {0.004f, 0.02f, 0.5f}) {
    const BoxQuery query(cloud, cell);
    for (int k = 0; k < 60; ++k) {
      QueryBox box = random_box(random, 0.1f, 0.1f);
      box.max[k % 3] = box.min[k % 3] + 0.002f;
      expect_brute_force(cloud, query, box);
    }
  }
}

TEST(BoxQuery, RowsWithGapsAndFarPoints) {
  // Two clusters in the same rows, a gap of 50 cells between them, and points that make rows of their own.
  PointCloud cloud = random_cloud(400, {-0.55f, -0.05f, -0.05f}, {-0.45f, 0.05f, 0.05f}, 9);
  const PointCloud other = random_cloud(400, {0.45f, -0.05f, -0.05f}, {0.6f, 0.05f, 0.05f}, 10);
  for (std::size_t i = 0; i < other.size(); ++i) cloud.push_back(other.point(i));
  for (const float far : {-9000.0f, -3.0f, 0.0f, 3.0f, 9000.0f}) cloud.push_back({far, 0.01f, 0.01f});
  const BoxQuery query(cloud, 0.02f);
  std::mt19937 random(11);
  for (int k = 0; k < 200; ++k) {
    QueryBox box = random_box(random, 0.05f, k % 4 == 0 ? 2.0f : 0.3f);
    box.origin.x() += k % 3 == 0 ? -0.5f : 0.5f;
    if (k % 5 == 0) box.rotation.setIdentity();
    expect_brute_force(cloud, query, box);
  }
}

TEST(BoxQuery, OrderIsFixedByPositionsAndBuffersAreReplaced) {
  const PointCloud cloud = random_cloud(3000, {-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}, 7);
  const BoxQuery query(cloud, 0.02f);
  std::mt19937 random(8);
  LocalPoints reused;
  for (int k = 0; k < 50; ++k) {
    const QueryBox box = random_box(random, 0.1f, 0.1f);
    LocalPoints fresh;
    query.find(box.origin, box.rotation, box.min, box.max, fresh);
    query.find(box.origin, box.rotation, box.min, box.max, reused);
    ASSERT_EQ(fresh.size(), reused.size());
    for (std::size_t i = 0; i < fresh.size(); ++i) {
      EXPECT_EQ(fresh.index[i], reused.index[i]);
      EXPECT_EQ(fresh.a[i], reused.a[i]);
      EXPECT_EQ(fresh.f[i], reused.f[i]);
      EXPECT_EQ(fresh.z[i], reused.z[i]);
    }
  }
}

}  // namespace
}  // namespace graspd
