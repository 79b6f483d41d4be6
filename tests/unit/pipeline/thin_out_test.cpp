// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/thin_out.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "tests/support/clouds.hpp"

namespace graspd {
namespace {

TEST(ThinOut, TakesOfTheGivenPointsTheOneNearestToTheMeanOfEachCell) {
  constexpr float kSpacing = 0.05f;
  const PointCloud cloud = random_cloud(3000, {-0.2f, -0.15f, -0.1f}, {0.2f, 0.15f, 0.1f}, 5);
  const auto cell = [&](std::size_t i) {
    const Eigen::Vector3f c = (cloud.point(i) / kSpacing).array().floor();
    return std::tuple(c.x(), c.y(), c.z());
  };
  std::pmr::vector<std::uint32_t> indices;  // the other points do not count
  for (std::uint32_t i = 0; i < cloud.size(); ++i)
    if (i % 3 != 1) indices.push_back(i);
  std::map<std::tuple<float, float, float>, std::pmr::vector<std::uint32_t>> cells;
  for (const std::uint32_t i : indices) cells[cell(i)].push_back(i);
  const std::pmr::vector<std::uint32_t> chosen = thin_out(cloud, indices, kSpacing);
  ASSERT_EQ(chosen.size(), cells.size());
  for (const std::uint32_t i : chosen) {
    const std::pmr::vector<std::uint32_t>& own = cells.at(cell(i));
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    for (const std::uint32_t k : own) mean += cloud.point(k);
    mean /= static_cast<float>(own.size());
    for (const std::uint32_t k : own)
      EXPECT_LE((cloud.point(i) - mean).norm(), (cloud.point(k) - mean).norm() + 1e-6f);
    cells.erase(cell(i));
  }
  EXPECT_TRUE(cells.empty()) << "cells without a point";
}

TEST(ThinOut, AnEmptyCloudHasNone) {
  EXPECT_TRUE(thin_out({}, {}, 0.01f).empty());
}

}  // namespace
}  // namespace graspd
