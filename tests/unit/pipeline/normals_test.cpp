// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/normals.hpp"

#include <gtest/gtest.h>
#include <pcl/features/normal_3d.h>
#include <pcl/search/kdtree.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "service/pipeline/downsample.hpp"
#include "service/pipeline/workspace_filter.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/scene_gallery.hpp"

namespace graspd {
namespace {

constexpr float kRadius = 0.009f;

double angle_deg(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  // By the chord: an arc cosine cannot tell small angles from none.
  const double half_chord = 0.5 * (a.cast<double>() - b.cast<double>()).norm();
  return 2 * std::asin(std::min(1.0, half_chord)) * 180 / std::numbers::pi;
}

Normals normals_of(const PointCloud& cloud, float radius_m = kRadius) {
  return estimate_normals(cloud, find_neighborhoods(cloud, {radius_m}));
}

void expect_all_zero(const Normals& normals) {
  for (std::size_t i = 0; i < normals.size(); ++i) EXPECT_EQ(normals.at(i), Eigen::Vector3f::Zero());
}

pcl::PointCloud<pcl::Normal> pcl_normals(const PointCloud& cloud, float radius_m) {
  pcl::PointCloud<pcl::PointXYZ>::Ptr points(new pcl::PointCloud<pcl::PointXYZ>);
  for (std::size_t i = 0; i < cloud.size(); ++i) points->emplace_back(cloud.x[i], cloud.y[i], cloud.z[i]);
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(points);
  estimation.setSearchMethod(pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  estimation.setRadiusSearch(radius_m);
  estimation.setViewPoint(cloud.viewpoint.x(), cloud.viewpoint.y(), cloud.viewpoint.z());
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  return normals;
}

/// How much larger the middle eigenvalue of the neighbourhood is than the smallest, relative to the sum:
/// where it is small the normal is not determined.
double gap_of_eigenvalues(const PointCloud& cloud, std::span<const std::uint32_t> neighborhood) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : neighborhood) mean += cloud.point(i).cast<double>();
  mean /= static_cast<double>(neighborhood.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::uint32_t i : neighborhood) {
    const Eigen::Vector3d d = cloud.point(i).cast<double>() - mean;
    covariance += d * d.transpose();
  }
  const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues();
  return (values[1] - values[0]) / values.sum();
}

void expect_pcl(const PointCloud& cloud, double least_share) {
  const Neighborhoods neighborhoods = find_neighborhoods(cloud, {kRadius});
  const Normals normals = estimate_normals(cloud, neighborhoods);
  const pcl::PointCloud<pcl::Normal> expected = pcl_normals(cloud, kRadius);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto neighborhood = neighborhoods.of(i);
    if (neighborhood.size() < 4 || gap_of_eigenvalues(cloud, neighborhood) < 0.05) continue;
    ++compared;
    const Eigen::Vector3f theirs = expected[i].getNormalVector3fMap();
    const bool grazing = std::abs(theirs.dot((cloud.viewpoint - cloud.point(i)).normalized())) < 1e-3f;
    const double angle = angle_deg(normals.at(i), theirs);
    // Seen edge-on, which side is towards the sensor is a matter of rounding.
    EXPECT_LT(grazing ? std::min(angle, 180 - angle) : angle, 0.15)
        << "point " << i << " of " << neighborhood.size();
  }
  EXPECT_GT(static_cast<double>(compared), least_share * static_cast<double>(cloud.size()));
}

TEST(Normals, AgreeWithPclOnAScene) {
  const PointCloud points = filter_workspace(render(three_objects()).cloud, {}).cloud;
  expect_pcl(downsample(points, {0.003f}).cloud, 0.98);
}

TEST(Normals, AgreeWithPclOnANoisyScene) {
  const PointCloud points =
      filter_workspace(with_range_noise(render(box_on_table()).cloud, 0.001f, 1), {}).cloud;
  expect_pcl(downsample(points, {0.003f}).cloud, 0.9);
}

TEST(Normals, AgreeWithPclOnScatteredPoints) {
  PointCloud cloud = random_cloud(4000, {0, 0, 0.5f}, {0.08f, 0.08f, 0.58f}, 1);
  expect_pcl(cloud, 0.5);
}

TEST(Normals, AgreeWithPclFarFromTheOrigin) {
  Eigen::Isometry3f away = Eigen::Isometry3f::Identity();
  away.translation() = Eigen::Vector3f(6, -7, 3);
  PointCloud cloud = moved(sphere_shell({0, 0, 0}, 0.05f, 3000), away);
  cloud.viewpoint = {6, -7, 2};
  // PCL's sums are around the origin, ours around the point: compare with the sphere instead.
  const Normals normals = normals_of(cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f radial = (cloud.point(i) - away.translation()).normalized();
    const double angle = angle_deg(normals.at(i), radial);
    EXPECT_LT(std::min(angle, 180 - angle), 1.5);
  }
}

TEST(Normals, ExactOnPlanes) {
  for (const auto& direction :
       {Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(1, 2, 3), Eigen::Vector3f(-3, 0.1f, 0.2f)}) {
    const Eigen::Vector3f n = direction.normalized(), u = n.unitOrthogonal(), v = n.cross(u);
    PointCloud cloud = grid_patch(0.4f * n, 0.003f * u, 0.003f * v, 20, 20);
    cloud.viewpoint = 2 * n;
    const Normals normals = normals_of(cloud);
    for (std::size_t i = 0; i < cloud.size(); ++i) EXPECT_LT(angle_deg(normals.at(i), n), 0.02);
    cloud.viewpoint = -2 * n;
    const Normals other_side = normals_of(cloud);
    for (std::size_t i = 0; i < cloud.size(); ++i) EXPECT_LT(angle_deg(other_side.at(i), -n), 0.02);
  }
}

TEST(Normals, RadialOnSpheresSeenFromOutside) {
  const PointCloud shell = sphere_shell({0, 0, 0}, 0.05f, 4000);
  for (const Eigen::Vector3f& eye : {Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0.2f, -0.3f, 0.8f)}) {
    PointCloud cloud = shell;
    cloud.viewpoint = eye;
    const Normals normals = normals_of(cloud);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3f radial = cloud.point(i).normalized(),
                            to_eye = (eye - cloud.point(i)).normalized();
      if (std::abs(radial.dot(to_eye)) < 0.05f) continue;
      EXPECT_LT(angle_deg(normals.at(i), radial.dot(to_eye) > 0 ? radial : Eigen::Vector3f(-radial)), 1.0);
    }
  }
}

TEST(Normals, UnitLengthOrZero) {
  const PointCloud cloud = random_cloud(3000, {0, 0, 0}, {0.1f, 0.1f, 0.1f}, 2);
  const Normals normals = normals_of(cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float length = normals.at(i).norm();
    EXPECT_TRUE(length == 0 || std::abs(length - 1) < 1e-5f) << length;
  }
}

TEST(Normals, ZeroWhereThereIsNoPlane) {
  expect_all_zero(normals_of({}));
  expect_all_zero(normals_of(random_cloud(1, {1, 1, 1}, {1, 1, 1}, 1)));
  expect_all_zero(normals_of(random_cloud(100, {1, 1, 1}, {1, 1, 1}, 1)));
  expect_all_zero(normals_of(random_cloud(2, {0, 0, 0}, {0.001f, 0.001f, 0.001f}, 1)));
  const PointCloud far_apart = grid_patch({0, 0, 0}, {0.1f, 0, 0}, {0, 0.1f, 0}, 10, 10);
  expect_all_zero(normals_of(far_apart));
}

TEST(Normals, ZeroOnLines) {
  expect_all_zero(normals_of(random_cloud(200, {0, 0, 0.5f}, {0.2f, 0, 0.5f}, 3)));
  const Eigen::Vector3f slope = 0.001f * Eigen::Vector3f(0.6f, -0.5f, 0.3f);
  expect_all_zero(normals_of(grid_patch({0.5f, 0.25f, 1}, slope, {0, 0, 0}, 100, 1)));
}

TEST(Normals, DuplicatesDoNotTurnThem) {
  PointCloud cloud = sphere_shell({0, 0, 1}, 0.05f, 2000);
  const Normals once = normals_of(cloud), twice = normals_of(doubled(cloud));
  for (std::size_t i = 0; i < cloud.size(); ++i) EXPECT_LT(angle_deg(once.at(i), twice.at(i)), 0.05);
}

}  // namespace
}  // namespace graspd
