// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Both forms of the kernels that a depth image is rendered with against the definition, and against each
// other to the bit.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "tests/unit/pipeline/kernel_forms.hpp"

namespace graspd {
namespace {

const Eigen::Vector3f kOrigin(0.1f, -0.2f, -0.5f);
constexpr std::size_t kSizes[] = {0, 1, 8, 13, 200};

Eigen::Matrix3f view_axes() {
  return Eigen::AngleAxisf(0.4f, Eigen::Vector3f(1, 2, 3).normalized()).toRotationMatrix();
}

ViewImage tilted_view() {
  ViewImage view{
      {kOrigin.x(), kOrigin.y(), kOrigin.z()}, {}, {30, 25}, {20.3f, 15.2f}, 40, 30, nullptr, nullptr};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) view.axes[i][j] = view_axes()(i, j);
  return view;
}

/// Points on both sides of the view's origin, the third one at it.
Points points_around(std::size_t size) {
  Points points(size, 3);
  if (size > 2) {
    points.x[2] = kOrigin.x();
    points.y[2] = kOrigin.y();
    points.z[2] = kOrigin.z();
  }
  return points;
}

Eigen::Vector3f offset(const Points& points, std::size_t k) {
  return Eigen::Vector3f(points.x[k], points.y[k], points.z[k]) - kOrigin;
}

TEST(ViewKernels, DirectionsAddUp) {
  for (const std::size_t size : kSizes) {
    const Points points = points_around(size);
    Eigen::Vector3f expected = Eigen::Vector3f::Zero();
    for (std::size_t k = 0; k < size; ++k) expected += offset(points, k).stableNormalized();
    const auto sums_of = [&](const Form& form) {
      DirectionSums sums{{1}, {}, {}};
      form.kernels->sum_directions(tilted_view(), points.range(), sums);
      return sums;
    };
    const auto parts = [](const DirectionSums& sums) {
      Eigen::Matrix<float, 8, 3> all;
      all << Eigen::Map<const Eigen::Matrix<float, 8, 1>>(sums.x),
          Eigen::Map<const Eigen::Matrix<float, 8, 1>>(sums.y),
          Eigen::Map<const Eigen::Matrix<float, 8, 1>>(sums.z);
      return all;
    };
    for (const Form& form : forms()) {
      const auto sums = parts(sums_of(form));
      const Eigen::Vector3f sum = sums.colwise().sum().transpose() - Eigen::Vector3f::UnitX();
      EXPECT_LT((sum - expected).norm(), 1e-4f) << form.name << " " << size << ": added to what was there";
      EXPECT_EQ(sums, parts(sums_of(forms().front()))) << form.name << " " << size;
    }
  }
}

TEST(ViewKernels, SlopesOfWhatIsBeforeTheSensor) {
  for (const std::size_t size : kSizes) {
    const Points points = points_around(size);
    const SlopeBounds wide{-0.01f, 0.01f, -0.02f, 0.02f};
    SlopeBounds expected = wide;
    int num_behind = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const Eigen::Vector3f p = view_axes() * offset(points, k);
      num_behind += p.z() > 0 ? 0 : 1;
      if (!(p.z() > 0)) continue;
      expected = {std::min(expected.left, p.x() / p.z()), std::max(expected.right, p.x() / p.z()),
                  std::min(expected.top, p.y() / p.z()), std::max(expected.bottom, p.y() / p.z())};
    }
    EXPECT_TRUE(size < 100 || num_behind > 10);
    const auto bounds_of = [&](const Form& form) {
      SlopeBounds bounds = wide;
      form.kernels->extend_slopes(tilted_view(), points.range(), bounds);
      return Eigen::Vector4f(bounds.left, bounds.right, bounds.top, bounds.bottom);
    };
    const Eigen::Vector4f right(expected.left, expected.right, expected.top, expected.bottom);
    for (const Form& form : forms()) {
      EXPECT_LT((bounds_of(form) - right).norm(), 1e-5f * right.norm()) << form.name << " " << size;
      EXPECT_EQ(bounds_of(form), bounds_of(forms().front())) << form.name << " " << size;
    }
  }
}

TEST(ViewKernels, PointsFallOnTheirPixels) {
  int num_inside = 0, num_outside = 0;
  for (const std::size_t size : kSizes) {
    const Points points = points_around(size);
    const auto seen_by = [&](const Form& form) {
      std::pair<std::vector<std::int32_t>, std::vector<float>> seen{size, size};
      form.kernels->find_pixels(tilted_view(), points.range(), seen.first.data(), seen.second.data());
      return seen;
    };
    for (const Form& form : forms()) {
      const auto [pixels, depths] = seen_by(form);
      for (std::size_t k = 0; k < size; ++k) {
        const Eigen::Vector3f p = view_axes() * offset(points, k);
        ASSERT_NEAR(p.z(), depths[k], 1e-6f);
        const float u = 30 * p.x() / p.z() + 20.8f, v = 25 * p.y() / p.z() + 15.7f;
        const bool is_inside = p.z() > 0 && u >= 0 && u < 40 && v >= 0 && v < 30;
        if (std::abs(u - std::round(u)) < 1e-3f || std::abs(v - std::round(v)) < 1e-3f) continue;
        EXPECT_EQ(pixels[k], is_inside ? static_cast<int>(v) * 40 + static_cast<int>(u) : -1)
            << form.name << " " << u << " " << v;
        (is_inside ? num_inside : num_outside) += 1;
      }
      EXPECT_EQ(seen_by(form), seen_by(forms().front())) << form.name << " " << size;
    }
  }
  EXPECT_GT(num_inside, 20);
  EXPECT_GT(num_outside, 20);
}

}  // namespace
}  // namespace graspd
