// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Both forms of the kernels that checks use against the definition, and against each other to the bit.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory_resource>
#include <numeric>
#include <random>
#include <vector>

#include "service/pipeline/point_kernels.hpp"
#include "tests/unit/pipeline/kernel_forms.hpp"

namespace graspd {
namespace {

TEST(CheckKernels, SumOverPointsWeighedByACircle) {
  const Points points(60, 11);
  for (const std::size_t num : {0, 1, 3, 8, 12, 40, 60}) {
    for (const CircleWeights& weights : {CircleWeights{0, 0, 0, 0}, CircleWeights{0.1f, -0.2f, 0.5f, 4}}) {
      double n = 0, xy = 0, qy = 0;
      for (std::size_t k = 0; k < num; ++k) {
        const double x = double{points.x[k]}, y = double{points.y[k]};
        const double e = (std::hypot(x - double{weights.x}, y - double{weights.y}) - double{weights.radius}) *
                         double{weights.per_scale};
        const double w = 1 / (1 + e * e);
        n += w;
        xy += w * x * y;
        qy += w * (x * x + y * y) * y;
      }
      const auto sums = [&](const PointKernels& kernels) {
        return kernels.sum_circle(weights, points.x.data(), points.y.data(), num);
      };
      const CircleSums expected = sums(portable_kernels());
      EXPECT_NEAR(expected.n, n, 1e-4);
      EXPECT_NEAR(expected.xy, xy, 1e-4);
      EXPECT_NEAR(expected.qy, qy, 1e-4);
      for (const Form& form : forms()) {
        const CircleSums s = sums(*form.kernels);
        const auto all = [](const CircleSums& c) {
          return std::array{c.n, c.x, c.y, c.xx, c.xy, c.yy, c.q, c.qx, c.qy};
        };
        EXPECT_EQ(all(s), all(expected)) << form.name << " " << num;
      }
    }
  }
}

TEST(CheckKernels, SumOverPointsWeighedByAProfile) {
  const Points points(60, 12);
  for (const std::size_t num : {0, 1, 7, 8, 17, 60}) {
    const FacePoints face{points.x.data(), points.y.data(), points.z.data(), num};
    for (const ProfileWeights& weights :
         {ProfileWeights{{0, 0, 0, 0}, 0}, ProfileWeights{{0.1f, -0.2f, 0.5f, 0.3f}, 4}}) {
      double n = 0, ssss = 0, ass = 0, zs = 0, za = 0, ee = 0;
      for (std::size_t k = 0; k < num; ++k) {
        const double s = double{points.x[k]}, a = double{points.y[k]}, z = double{points.z[k]};
        const float* c = weights.c;
        const double e = (double{c[0]} + double{c[1]} * s + double{c[2]} * s * s + double{c[3]} * a - z) *
                         double{weights.per_scale};
        const double w = 1 / (1 + e * e);
        n += w;
        ssss += w * s * s * s * s;
        ass += w * a * s * s;
        zs += w * z * s;
        za += w * z * a;
        ee += w * e * e;
      }
      const ProfileSums expected = portable_kernels().sum_profile(weights, face);
      EXPECT_NEAR(double{expected.n}, n, 1e-4);
      EXPECT_NEAR(double{expected.ssss}, ssss, 1e-4);
      EXPECT_NEAR(double{expected.ass}, ass, 1e-4);
      EXPECT_NEAR(double{expected.zs}, zs, 1e-4);
      EXPECT_NEAR(double{expected.za}, za, 1e-4);
      EXPECT_NEAR(double{expected.ee}, ee, 1e-4);
      for (const Form& form : forms()) {
        const ProfileSums sums = form.kernels->sum_profile(weights, face);
        const auto all = [](const ProfileSums& p) {
          return std::array{p.n,   p.s,  p.ss, p.sss, p.ssss, p.a,  p.as,
                            p.ass, p.aa, p.z,  p.zs,  p.zss,  p.za, p.ee};
        };
        EXPECT_EQ(all(sums), all(expected)) << form.name << " " << num;
      }
    }
  }
}

TEST(CheckKernels, TagBandsAndKeepDepths) {
  constexpr std::int32_t kOwn = 3;
  for (const std::size_t size : {0, 5, 8, 21, 400}) {
    Points points(size, 5);
    constexpr std::uint32_t kVoxels = 41;
    std::pmr::vector<std::int32_t> object_of_voxel(kVoxels);
    for (std::size_t i = 0; i < kVoxels; ++i) object_of_voxel[i] = static_cast<std::int32_t>(i % 7) - 2;
    std::pmr::vector<std::uint32_t> voxel_of_point(size + 1000 + kPointPadding);
    for (std::uint32_t i = 0; i < voxel_of_point.size(); ++i) voxel_of_point[i] = 5 * i % kVoxels;
    const BandPoints band{points.x.data(), points.y.data(), points.index.data(), size};
    const BandTags tags{object_of_voxel.data(), voxel_of_point.data(), kOwn, -0.8f, 0.01f, 150};
    for (const Form& form : forms()) {
      std::pmr::vector<std::int32_t> own(size + kPointPadding, -9), marks(own);
      form.kernels->tag_band(tags, band, own.data(), marks.data());
      std::pmr::vector<float> expected;
      for (std::size_t k = 0; k < size; ++k) {
        const std::int32_t object = object_of_voxel[voxel_of_point[points.index[k]]];
        EXPECT_EQ(own[k], object == kOwn ? 1 : 0);
        const auto bin = static_cast<std::int32_t>(std::floor((points.x[k] + 0.8f) / 0.01f));
        const bool has_none = bin < 0 || bin >= 150;
        EXPECT_EQ(marks[k], has_none ? 384 : bin + 192 * own[k]) << form.name << " " << points.x[k];
        if (object == kOwn && points.x[k] >= -0.5f && points.x[k] <= 0.25f && points.y[k] >= -0.7f)
          expected.push_back(points.y[k]);
      }
      std::pmr::vector<float> depths(size + kPointPadding);
      depths.resize(form.kernels->keep_depths(band, own.data(), {-0.5f, 0.25f, -0.7f}, depths.data()));
      EXPECT_EQ(depths, expected) << form.name << " " << size;
    }
  }
}

TEST(CheckKernels, SelectPartsOfABand) {
  constexpr float kAnywhere = std::numeric_limits<float>::infinity();
  for (const std::size_t size : {0, 7, 8, 9, 400}) {
    Points points(size, 8);
    // On the bounds belongs to the part, NaN never does, and what is beyond the points does not count.
    if (size > 2) points.x[1] = 0.1f + 0.25f;
    if (size > 2) points.y[2] = std::numeric_limits<float>::quiet_NaN();
    const BandPoints band{points.x.data(), points.y.data(), points.index.data(), size};
    for (const BandLimits& limits : {BandLimits{0.1f, -0.2f, 0.0f, 0.1f + 0.25f - 0.1f, -0.5f, 0.5f},
                                     BandLimits{0, 0.3f, 0.5f, kAnywhere, -1, 0}}) {
      std::pmr::vector<std::uint32_t> expected;
      for (std::uint32_t k = 0; k < size; ++k) {
        const float distance = std::abs(points.x[k] - limits.middle), depth = points.y[k] - limits.top;
        if (distance >= limits.min_distance && distance <= limits.max_distance && depth >= limits.min_depth &&
            depth <= limits.max_depth)
          expected.push_back(k);
      }
      for (const Form& form : forms()) {
        std::pmr::vector<std::uint32_t> selected(size + kPointPadding + 1, kUntouched);
        const std::size_t n = form.kernels->select_band(limits, band, selected.data());
        EXPECT_EQ(selected.back(), kUntouched) << "writes beyond the room that is asked for";
        selected.resize(n);
        EXPECT_EQ(selected, expected) << form.name << " " << size;
      }
    }
  }
}

TEST(CheckKernels, DescribeTheObjectsPointsOfABand) {
  constexpr std::int32_t kMarks = 50;
  const BandLimits limits{0.1f, -0.2f, 0, 0.3f, -0.5f, 0.5f};
  for (const std::size_t size : {0, 7, 8, 9, 400}) {
    const Points points(size, 8);
    const BandPoints band{points.x.data(), points.y.data(), points.index.data(), size};
    // Beyond the points all are the object's: they must not count.
    std::pmr::vector<std::int32_t> own(size + kPointPadding, 1), marks(own.size(), kMarks);
    for (std::size_t k = 0; k < size; ++k) {
      own[k] = k % 3 == 0 ? 1 : 0;
      marks[k] = static_cast<std::int32_t>(7 * k % kMarks);
    }
    std::pmr::vector<std::uint32_t> all(size + kPointPadding), expected;
    all.resize(portable_kernels().select_band(limits, band, all.data()));
    std::pmr::vector<std::uint8_t> expected_marked(kMarks + 1);
    float expected_low = -0.05f, expected_high = -0.05f;
    for (const std::uint32_t k : all) {
      expected_marked[static_cast<std::size_t>(marks[k])] = 1;
      if (own[k] == 0) continue;
      expected.push_back(k);
      expected_low = std::min(expected_low, points.x[k]);
      expected_high = std::max(expected_high, points.x[k]);
    }
    for (const Form& form : forms()) {
      std::pmr::vector<std::uint32_t> selected(size + kPointPadding + 1, kUntouched);
      const BandCounts n = form.kernels->select_own(limits, band, own.data(), selected.data());
      EXPECT_EQ(n.all, all.size()) << form.name << " " << size;
      EXPECT_EQ(selected.back(), kUntouched) << "writes beyond the room that is asked for";
      selected.resize(n.own);
      EXPECT_EQ(selected, expected) << form.name << " " << size;
      float low = -0.05f, high = -0.05f;
      form.kernels->extend_own(limits, band, own.data(), low, high);
      EXPECT_EQ(low, expected_low) << form.name << " " << size;
      EXPECT_EQ(high, expected_high) << form.name << " " << size;
      std::pmr::vector<std::uint8_t> marked(expected_marked.size());
      form.kernels->mark_band(limits, band, marks.data(), marked.data());
      EXPECT_EQ(marked, expected_marked) << form.name << " " << size;
    }
  }
}

std::int32_t expected_hider(const ViewImage& image, const Eigen::Vector3f& p, float margin_m) {
  const float dx = p.x() - image.origin[0], dy = p.y() - image.origin[1], dz = p.z() - image.origin[2];
  const auto along = [&](int i) {
    return image.axes[i][0] * dx + image.axes[i][1] * dy + image.axes[i][2] * dz;
  };
  const float z = along(2), u = image.focal[0] * along(0) / z + image.center[0] + 0.5f,
              v = image.focal[1] * along(1) / z + image.center[1] + 0.5f;
  if (z <= 0) return -1;
  if (v < 0) return image.above;
  if (v >= static_cast<float>(image.height)) return image.below;
  if (u < 0 || u >= static_cast<float>(image.width)) return image.beside;
  const int pixel = static_cast<int>(v) * image.width + static_cast<int>(u);
  return image.depth[pixel] > 0 && image.depth[pixel] < z - margin_m ? image.point[pixel] : -1;
}

TEST(CheckKernels, FindWhatHidesPlacesInAnImage) {
  constexpr std::int32_t kWidth = 40, kHeight = 30, kBeside = -5, kAbove = -6, kBelow = -7;
  constexpr float kMargin = 0.05f;
  std::vector<float> depth(kWidth * kHeight, 0.8f);
  std::vector<std::int32_t> point(depth.size());
  std::iota(point.begin(), point.end(), 0);
  for (std::size_t i = 0; i < depth.size(); i += 3) depth[i] = 0;  // nothing seen
  const float c = std::cos(0.2f), s = std::sin(0.2f);
  const ViewImage image{{0.1f, 0, -0.1f},
                        {{c, 0, -s}, {0, 1, 0}, {s, 0, c}},
                        {30, 33},
                        {19, 14},
                        kWidth,
                        kHeight,
                        depth.data(),
                        point.data(),
                        kBeside,
                        kAbove,
                        kBelow};
  std::mt19937 random(12);
  std::uniform_real_distribution<float> unit(-1, 1);
  int num_hidden = 0;
  std::map<std::int32_t, int> num_others;
  for (int round = 0; round < 300; ++round) {
    Probes places;
    for (std::size_t k = 0; k < kProbes; ++k) {
      places.x[k] = unit(random);
      places.y[k] = unit(random);
      places.z[k] = 0.8f + unit(random);  // some behind the sensor
    }
    for (const Form& form : forms()) {
      std::int32_t hiders[kProbes];
      form.kernels->find_hiders(image, places, kMargin, hiders);
      for (std::size_t k = 0; k < kProbes; ++k) {
        const auto expected = expected_hider(image, {places.x[k], places.y[k], places.z[k]}, kMargin);
        ASSERT_EQ(hiders[k], expected) << form.name << " round " << round << " place " << k;
        ++(expected < 0 ? num_others[expected] : num_hidden);
      }
    }
  }
  EXPECT_GT(num_hidden, 100);
  for (const std::int32_t other : {-1, kBeside, kAbove, kBelow}) EXPECT_GT(num_others[other], 20) << other;
}

TEST(CheckKernels, TheFirstFewOfManyValues) {
  std::mt19937 random(13);
  for (const std::size_t size : {0, 1, 3, 4, 7, 8, 9, 16, 31, 200}) {
    for (const unsigned levels : {3u, 1000000u}) {  // with many equal values, and hardly any
      std::pmr::vector<float> values(size), sorted;
      for (float& value : values) value = static_cast<float>(random() % levels) - 1.5f;
      for (const bool largest : {false, true}) {
        sorted = values;
        std::sort(sorted.begin(), sorted.end());
        if (largest) std::reverse(sorted.begin(), sorted.end());
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        sorted.resize(std::max(size, kFew), largest ? -kInfinity : kInfinity);
        for (const Form& form : forms()) {
          float few[kFew];
          form.kernels->first_few(values.data(), size, largest, few);
          for (std::size_t k = 0; k < kFew; ++k)
            EXPECT_EQ(few[k], sorted[k]) << form.name << " " << size << " " << k << " " << largest;
        }
      }
    }
  }
}

}  // namespace
}  // namespace graspd
