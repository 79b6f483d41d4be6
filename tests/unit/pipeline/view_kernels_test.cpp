// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Both forms of the kernels that a depth image is rendered with against the definition, and against each
// other to the bit.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/unit/pipeline/kernel_forms.hpp"

namespace graspd {
namespace {

struct Seen {
  std::vector<float> x, y, z;
  std::vector<std::int32_t> pixel;
  bool operator==(const Seen&) const = default;
};

TEST(ViewKernels, PointsFallOnTheirPixels) {
  const Eigen::Matrix3f axes =
      Eigen::AngleAxisf(0.4f, Eigen::Vector3f(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3f origin(0.1f, -0.2f, -0.5f);
  ViewImage view{
      {origin.x(), origin.y(), origin.z()}, {}, {30, 25}, {20.3f, 15.2f}, 40, 30, nullptr, nullptr};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) view.axes[i][j] = axes(i, j);
  int num_inside = 0, num_outside = 0;
  for (const std::size_t size : {0, 1, 8, 13, 200}) {
    const Points points(size, 3);
    Seen expected;
    for (const Form& form : forms()) {
      Seen seen{std::vector<float>(size), std::vector<float>(size), std::vector<float>(size),
                std::vector<std::int32_t>(size)};
      const ViewPoints out{seen.x.data(), seen.y.data(), seen.z.data()};
      form.kernels->see_points(view, points.range(), out);
      form.kernels->find_pixels(view, out, size, seen.pixel.data());
      for (std::size_t k = 0; k < size; ++k) {
        const Eigen::Vector3f p = axes * (Eigen::Vector3f(points.x[k], points.y[k], points.z[k]) - origin);
        ASSERT_LT((p - Eigen::Vector3f(seen.x[k], seen.y[k], seen.z[k])).norm(), 1e-6f);
        const float u = 30 * p.x() / p.z() + 20.8f, v = 25 * p.y() / p.z() + 15.7f;
        const bool is_inside = p.z() > 0 && u >= 0 && u < 40 && v >= 0 && v < 30;
        if (std::abs(u - std::round(u)) < 1e-3f || std::abs(v - std::round(v)) < 1e-3f) continue;
        EXPECT_EQ(seen.pixel[k], is_inside ? static_cast<int>(v) * 40 + static_cast<int>(u) : -1)
            << form.name << " " << u << " " << v;
        (is_inside ? num_inside : num_outside) += 1;
      }
      if (form.kernels == &portable_kernels()) expected = seen;
      EXPECT_EQ(seen, expected) << form.name << " " << size;
    }
  }
  EXPECT_GT(num_inside, 20);
  EXPECT_GT(num_outside, 20);
}

}  // namespace
}  // namespace graspd
