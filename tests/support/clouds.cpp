// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/clouds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

namespace graspd {
namespace {

PointCloud as_list(PointCloud cloud) {
  cloud.width = static_cast<int>(cloud.size());
  cloud.height = 1;
  return cloud;
}

}  // namespace

PointCloud random_cloud(std::size_t n, const Eigen::Vector3f& min, const Eigen::Vector3f& max,
                        std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  PointCloud cloud;
  for (std::size_t i = 0; i < n; ++i) {
    const float x = unit(random), y = unit(random), z = unit(random);
    cloud.push_back(min + Eigen::Vector3f(x, y, z).cwiseProduct(max - min));
  }
  return as_list(std::move(cloud));
}

PointCloud grid_patch(const Eigen::Vector3f& corner, const Eigen::Vector3f& u, const Eigen::Vector3f& v,
                      int nu, int nv) {
  PointCloud cloud;
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i)
      cloud.push_back(corner + static_cast<float>(i) * u + static_cast<float>(j) * v);
  cloud.width = nu;
  cloud.height = nv;
  return cloud;
}

PointCloud sphere_shell(const Eigen::Vector3f& center, float radius_m, std::size_t n) {
  PointCloud cloud;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = 1 - 2 * (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    const double angle = std::numbers::pi * (3 - std::sqrt(5.0)) * static_cast<double>(i),
                 r = std::sqrt(1 - z * z);
    cloud.push_back(center +
                    radius_m * Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z).cast<float>());
  }
  return as_list(std::move(cloud));
}

PointCloud box_shell(const Eigen::Vector3f& min, const Eigen::Vector3f& max, float spacing_m) {
  PointCloud cloud;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3f u = spacing_m * Eigen::Vector3f::Unit((axis + 1) % 3);
    const Eigen::Vector3f v = spacing_m * Eigen::Vector3f::Unit((axis + 2) % 3);
    // Half a spacing away from the edges, so that none is sampled twice.
    const int nu = static_cast<int>((max - min)[(axis + 1) % 3] / spacing_m + 0.5f);
    const int nv = static_cast<int>((max - min)[(axis + 2) % 3] / spacing_m + 0.5f);
    for (const bool far : {false, true}) {
      Eigen::Vector3f corner = min + 0.5f * (u + v);
      if (far) corner[axis] = max[axis];
      cloud = joined(cloud, grid_patch(corner, u, v, nu, nv));
    }
  }
  return cloud;
}

PointCloud joined(const PointCloud& a, const PointCloud& b) {
  PointCloud cloud = a;
  for (std::size_t i = 0; i < b.size(); ++i) cloud.push_back(b.point(i));
  return as_list(std::move(cloud));
}

PointCloud shuffled(const PointCloud& cloud, std::uint32_t seed) {
  std::pmr::vector<std::size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  PointCloud result;
  result.viewpoint = cloud.viewpoint;
  for (const std::size_t i : order) result.push_back(cloud.point(i));
  return as_list(std::move(result));
}

PointCloud moved(const PointCloud& cloud, const Eigen::Isometry3f& T) {
  PointCloud result = cloud;
  result.viewpoint = T * cloud.viewpoint;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f p = T * cloud.point(i);
    result.x[i] = p.x();
    result.y[i] = p.y();
    result.z[i] = p.z();
  }
  return result;
}

PointCloud finite_points(const PointCloud& cloud) {
  PointCloud result;
  result.viewpoint = cloud.viewpoint;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud.point(i).allFinite()) result.push_back(cloud.point(i));
  return as_list(std::move(result));
}

PointCloud doubled(const PointCloud& cloud) {
  return joined(cloud, cloud);
}

PointCloud with_missing_between(const PointCloud& cloud, std::size_t every) {
  PointCloud result;
  result.viewpoint = cloud.viewpoint;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    result.push_back(cloud.point(i));
    if (i % every == 0) result.push_back(Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  }
  return as_list(std::move(result));
}

PointCloud with_range_noise(const PointCloud& cloud, float sigma_m, std::uint32_t seed) {
  return with_range_noise(
      cloud, [sigma_m](float) { return sigma_m; }, seed);
}

PointCloud with_range_noise(const PointCloud& cloud, const std::function<float(float range_m)>& sigma_m,
                            std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise;
  PointCloud result = cloud;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f ray = cloud.point(i) - cloud.viewpoint;
    const Eigen::Vector3f p = cloud.point(i) + noise(random) * sigma_m(ray.norm()) * ray.normalized();
    result.x[i] = p.x();
    result.y[i] = p.y();
    result.z[i] = p.z();
  }
  return result;
}

}  // namespace graspd
