// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/region_growing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>

#include "tests/support/clouds.hpp"
#include "tests/unit/pipeline/voxel_surfaces.hpp"

namespace graspd {
namespace {

/// A cloud with everything that growing needs to know of it.
struct Input {
  PointCloud cloud;
  Neighborhoods neighborhoods;
  Normals normals;
  std::pmr::vector<std::uint8_t> is_edge;
  SmoothnessConfig config;

  Input(PointCloud points, const SmoothnessConfig& smoothness)
      : cloud(std::move(points)), config(smoothness) {
    neighborhoods = find_neighborhoods(cloud, {kTestRadius});
    normals = estimate_normals(cloud, neighborhoods);
    is_edge = find_edge_points(normals, neighborhoods, config);
  }
  [[nodiscard]] Labels grow(const std::pmr::vector<std::uint8_t>& excluded = {}) const {
    return grow_regions(normals, neighborhoods, is_edge, excluded, config);
  }
};

double angle_deg(const Normals& normals, std::size_t s, std::size_t p) {
  const double cosine = normals.at(s).cast<double>().dot(normals.at(p).cast<double>());
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
}

/// The rule read once more: all pairs, a matrix of links, flooding. Labels by the first point of each
/// component.
class PairwiseOracle {
 public:
  PairwiseOracle(const Input& in, const std::pmr::vector<std::uint8_t>& excluded)
      : in_(in), excluded_(excluded) {
    const std::size_t n = in.cloud.size();
    linked_.assign(n, std::vector<bool>(n));
    for (std::size_t s = 0; s < n; ++s)
      for (std::size_t p = 0; p < n; ++p) linked_[s][p] = near(s, p) && is_link(s, p);
    flood();
  }

  /// Label of the component, -1 when none of its points is a surface point (or the point is excluded).
  [[nodiscard]] const std::pmr::vector<std::int32_t>& grown() const { return label_; }
  [[nodiscard]] bool near(std::size_t s, std::size_t p) const {
    return (in_.cloud.point(s) - in_.cloud.point(p)).norm() <= kTestRadius;
  }
  [[nodiscard]] bool takes_part(std::size_t s) const { return excluded_.empty() || !excluded_[s]; }
  [[nodiscard]] int num_labels() const { return num_labels_; }
  [[nodiscard]] int num_unclear() const { return num_unclear_; }

 private:
  bool is_link(std::size_t s, std::size_t p) {
    if (!takes_part(s) || !takes_part(p) || in_.normals.at(s).isZero() || in_.normals.at(p).isZero())
      return false;
    const double theta = angle_deg(in_.normals, s, p);
    for (const double limit : {in_.config.theta_low_deg, in_.config.theta_high_deg})
      num_unclear_ += std::abs(theta - limit) < 1e-5 ? 1 : 0;
    return theta < in_.config.theta_low_deg ||
           (theta < in_.config.theta_high_deg && !in_.is_edge[s] && !in_.is_edge[p]);
  }

  void flood() {
    const std::size_t n = in_.cloud.size();
    label_.assign(n, -1);
    std::vector<bool> visited(n);
    for (std::size_t first = 0; first < n; ++first) {
      if (visited[first] || !takes_part(first)) continue;
      std::pmr::vector<std::size_t> component{first};
      visited[first] = true;
      for (std::size_t k = 0; k < component.size(); ++k)
        for (std::size_t p = 0; p < n; ++p)
          if (linked_[component[k]][p] && !visited[p]) {
            visited[p] = true;
            component.push_back(p);
          }
      if (std::all_of(component.begin(), component.end(), [&](std::size_t s) { return in_.is_edge[s] != 0; }))
        continue;
      for (const std::size_t s : component) label_[s] = num_labels_;
      ++num_labels_;
    }
  }

  const Input& in_;
  const std::pmr::vector<std::uint8_t>& excluded_;
  std::vector<std::vector<bool>> linked_;
  std::pmr::vector<std::int32_t> label_;
  int num_labels_ = 0, num_unclear_ = 0;
};

/// Whether a label is that of a neighbour with a grown label whose normal is (as good as) the most similar.
bool is_most_similar(const Input& in, const PairwiseOracle& oracle, std::size_t s, std::int32_t label) {
  double best = -2, of_label = -2;
  for (std::size_t p = 0; p < in.cloud.size(); ++p) {
    if (oracle.grown()[p] < 0 || !oracle.near(s, p)) continue;
    const double cosine = in.normals.at(s).cast<double>().dot(in.normals.at(p).cast<double>());
    best = std::max(best, cosine);
    if (oracle.grown()[p] == label) of_label = std::max(of_label, cosine);
  }
  return label < 0 ? best == -2 : of_label > best - 1e-6;
}

void expect_rule(const Input& in, const std::pmr::vector<std::uint8_t>& excluded = {}) {
  const PairwiseOracle oracle(in, excluded);
  ASSERT_EQ(oracle.num_unclear(), 0) << "the test's own cloud is on a threshold";
  const Labels labels = in.grow(excluded);
  ASSERT_EQ(labels.of_point.size(), in.cloud.size());
  EXPECT_EQ(labels.num_labels, oracle.num_labels());
  for (std::size_t s = 0; s < in.cloud.size(); ++s) {
    if (oracle.grown()[s] >= 0)
      EXPECT_EQ(labels.of_point[s], oracle.grown()[s]) << "point " << s;
    else if (!oracle.takes_part(s))
      EXPECT_EQ(labels.of_point[s], -1) << "point " << s << " is excluded";
    else
      EXPECT_TRUE(is_most_similar(in, oracle, s, labels.of_point[s])) << "edge point " << s;
  }
}

SmoothnessConfig thresholds(float low_deg, float high_deg, float share = 0.2f) {
  return {low_deg, high_deg, share};
}

/// Voxels of a box lying on a plane, small enough for all pairs.
PointCloud box_on_plane() {
  PointCloud cloud = joined(box_shell({0, 0, 0}, {0.03f, 0.04f, 0.03f}, 0.0029f),
                            grid_patch({-0.03f, -0.02f, 0}, {0.0031f, 0, 0}, {0, 0.0031f, 0}, 28, 28));
  cloud.viewpoint = {0.3f, -0.2f, 0.5f};
  return with_range_noise(cloud, 0.0003f, 3);
}

TEST(RegionGrowing, EmptyCloud) {
  EXPECT_EQ(Input({}, {}).grow().num_labels, 0);
}

TEST(RegionGrowing, FollowsItsRuleOnABox) {
  for (const float share : {0.0f, 0.2f, 0.5f})
    for (const auto& [low, high] : {std::pair{4.0f, 15.0f}, {2.0f, 30.0f}, {8.0f, 8.0f}, {1.0f, 12.0f}})
      expect_rule(Input(box_on_plane(), thresholds(low, high, share)));
}

TEST(RegionGrowing, FollowsItsRuleOnASphere) {
  PointCloud sphere = sphere_shell({0, 0, 0.5f}, 0.03f, 1500);
  expect_rule(Input(with_range_noise(sphere, 0.0002f, 1), thresholds(4, 15)));
}

TEST(RegionGrowing, FollowsItsRuleOnScatteredPoints) {
  for (std::uint32_t seed = 0; seed < 3; ++seed)
    expect_rule(
        Input(random_cloud(900, {0, 0, 0.4f}, {0.06f, 0.06f, 0.44f}, seed), thresholds(10, 40, 0.5f)));
}

TEST(RegionGrowing, FollowsItsRuleWithExcludedPoints) {
  const Input in(box_on_plane(), thresholds(4, 15));
  std::pmr::vector<std::uint8_t> excluded(in.cloud.size());
  for (std::size_t i = 0; i < excluded.size(); ++i) excluded[i] = in.cloud.z[i] < 0.003f ? 1 : 0;
  expect_rule(in, excluded);
}

TEST(RegionGrowing, ExcludedPointsAreNoBridge) {
  const Input in(grid_patch({0, 0, 1}, {0.003f, 0, 0}, {0, 0.003f, 0}, 40, 10), thresholds(4, 15));
  EXPECT_EQ(in.grow().num_labels, 1);
  std::pmr::vector<std::uint8_t> strip(in.cloud.size());
  for (std::size_t i = 0; i < strip.size(); ++i) strip[i] = std::abs(in.cloud.x[i] - 0.06f) < 0.0062f ? 1 : 0;
  const Labels split = in.grow(strip);
  EXPECT_EQ(split.num_labels, 2);
  for (std::size_t i = 0; i < strip.size(); ++i) {
    if (strip[i]) {
      EXPECT_EQ(split.of_point[i], -1);
    } else {
      EXPECT_EQ(split.of_point[i], in.cloud.x[i] < 0.06f ? 0 : 1);
    }
  }
}

/// More points than are linked at a time, in an order that puts most neighbours into other parts.
TEST(RegionGrowing, LinksAcrossThePartsOfALargeCloud) {
  const PointCloud plane = grid_patch({0, 0, 0.5f}, {0.003f, 0, 0}, {0, 0.003f, 0}, 180, 160);
  const std::size_t n = plane.size();
  ASSERT_GT(n, 3 * 8192u);
  PointCloud spread;
  for (std::size_t i = 0; i < n; ++i) spread.push_back(plane.point(i * 7 % n));
  for (const PointCloud* cloud : {&plane, static_cast<const PointCloud*>(&spread)}) {
    const Input in(*cloud, {4, 15, 0.2f});
    EXPECT_EQ(in.grow().num_labels, 1);
    // Two halves and what is between them, wide enough to part them.
    std::pmr::vector<std::uint8_t> excluded(n);
    for (std::size_t i = 0; i < n; ++i) excluded[i] = std::abs(cloud->x[i] - 0.27f) < 0.006f ? 1 : 0;
    const Labels labels = in.grow(excluded);
    EXPECT_EQ(labels.num_labels, 2);
    const std::size_t first = excluded[0] ? 1 : 0;
    for (std::size_t i = 0; i < n; ++i) {
      const bool is_same_half = (cloud->x[i] < 0.27f) == (cloud->x[first] < 0.27f);
      ASSERT_EQ(labels.of_point[i], excluded[i] ? -1 : is_same_half ? 0 : 1) << i;
    }
  }
}

TEST(RegionGrowing, LabelsCountFromTheFirstPoint) {
  const Labels labels = Input(box_on_plane(), thresholds(4, 15)).grow();
  std::int32_t next = 0;
  for (const std::int32_t label : labels.of_point) {
    // Edge points that were attached later may come before the first point that grew.
    if (label == next) ++next;
    EXPECT_LT(label, labels.num_labels);
  }
  EXPECT_EQ(next, labels.num_labels);
}

/// The same partition of the points, whatever the labels are called.
bool same_partition(const std::pmr::vector<std::int32_t>& a, const std::pmr::vector<std::int32_t>& b) {
  std::map<std::int32_t, std::int32_t> to_b, to_a;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (to_b.try_emplace(a[i], b[i]).first->second != b[i] ||
        to_a.try_emplace(b[i], a[i]).first->second != a[i])
      return false;
  return true;
}

TEST(RegionGrowing, DoesNotDependOnTheOrderOfThePoints) {
  const PointCloud cloud = box_on_plane();
  const Input in(cloud, thresholds(4, 15));
  const Labels labels = in.grow();
  std::pmr::vector<std::uint32_t> order(cloud.size());
  std::iota(order.begin(), order.end(), 0u);
  std::mt19937 random(5);
  for (int round = 0; round < 5; ++round) {
    std::shuffle(order.begin(), order.end(), random);
    // Normals and edge points of the first order: their rounding depends on the order, the rule does not.
    PointCloud permuted;
    Normals normals;
    std::pmr::vector<std::uint8_t> is_edge;
    for (const std::uint32_t i : order) {
      permuted.push_back(cloud.point(i));
      normals.x.push_back(in.normals.x[i]);
      normals.y.push_back(in.normals.y[i]);
      normals.z.push_back(in.normals.z[i]);
      is_edge.push_back(in.is_edge[i]);
    }
    const Labels other =
        grow_regions(normals, find_neighborhoods(permuted, {kTestRadius}), is_edge, {}, in.config);
    std::pmr::vector<std::int32_t> back(cloud.size());
    for (std::size_t k = 0; k < order.size(); ++k) back[order[k]] = other.of_point[k];
    EXPECT_TRUE(same_partition(labels.of_point, back));
  }
}

}  // namespace
}  // namespace graspd
