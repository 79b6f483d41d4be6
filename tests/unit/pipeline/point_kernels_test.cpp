// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Both forms of each kernel against the definition, and against each other to the bit.
#include "service/pipeline/point_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory_resource>
#include <numeric>
#include <random>
#include <vector>

#include "tests/unit/pipeline/kernel_forms.hpp"

namespace graspd {
namespace {

BoxTest tilted_box() {
  BoxTest box{};
  const float c = std::cos(0.4f), s = std::sin(0.4f);
  const float rows[3][3] = {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) box.to_local[i][j] = rows[i][j];
    box.shift[i] = 0.1f * static_cast<float>(i);
    box.min[i] = -0.5f;
    box.max[i] = 0.4f + 0.1f * static_cast<float>(i);
  }
  return box;
}

struct Kept {
  std::pmr::vector<float> a, f, z;
  std::pmr::vector<std::uint32_t> index;
  bool operator==(const Kept&) const = default;
};

Kept keep_inside(const PointKernels& kernels, const BoxTest& box, const Points& points) {
  const std::size_t room = points.size + kPointPadding;
  Kept kept{std::pmr::vector<float>(room), std::pmr::vector<float>(room), std::pmr::vector<float>(room),
            std::pmr::vector<std::uint32_t>(room + 1, kUntouched)};
  const std::size_t n = kernels.keep_inside(box, points.range(), points.spans(),
                                            {kept.a.data(), kept.f.data(), kept.z.data(), kept.index.data()});
  EXPECT_EQ(kept.index.back(), kUntouched) << "writes beyond the room that is asked for";
  for (std::pmr::vector<float>* v : {&kept.a, &kept.f, &kept.z}) v->resize(n);
  kept.index.resize(n);
  return kept;
}

TEST(PointKernels, KeepWhatIsInTheBox) {
  const BoxTest box = tilted_box();
  for (const std::size_t size : {0, 1, 7, 8, 9, 31, 32, 33, 1000}) {
    const Points points(size);
    const Kept expected = keep_inside(portable_kernels(), box, points);
    std::size_t k = 0;
    for (std::size_t i = 0; i < size; ++i) {
      double margin = 1;
      for (int axis = 0; axis < 3; ++axis) {
        const auto& row = box.to_local[axis];
        const double local = double{row[0]} * double{points.x[i]} + double{row[1]} * double{points.y[i]} +
                             double{row[2]} * double{points.z[i]} + double{box.shift[axis]};
        margin = std::min({margin, local - double{box.min[axis]}, double{box.max[axis]} - local});
      }
      ASSERT_GT(std::abs(margin), 1e-6) << "too near to a face to tell; take another seed";
      if (margin < 0) continue;
      ASSERT_LT(k, expected.index.size());
      EXPECT_EQ(expected.index[k++], points.index[i]);
    }
    EXPECT_EQ(k, expected.index.size());
    for (const Form& form : forms()) {
      EXPECT_EQ(keep_inside(*form.kernels, box, points), expected) << form.name << " " << size;
      EXPECT_EQ(form.kernels->count_inside(box, points.range(), points.spans(), size), k)
          << form.name << " " << size;
    }
  }
}

TEST(PointKernels, OnlyTheSpansCountAndOnlyUntilThereAreEnough) {
  const BoxTest box = tilted_box();
  const Points points(200, 9);
  const std::vector<PointSpan> spans{{3, 20}, {50, 59}, {100, 200}};
  std::pmr::vector<std::uint32_t> expected;
  const Kept all = keep_inside(portable_kernels(), box, points);
  for (const std::uint32_t index : all.index)
    for (const PointSpan& span : spans)
      if (index - 1000 >= span.begin && index - 1000 < span.end) expected.push_back(index);
  ASSERT_GT(expected.size(), 5u);
  for (const Form& form : forms()) {
    Kept kept{std::pmr::vector<float>(209), std::pmr::vector<float>(209), std::pmr::vector<float>(209),
              std::pmr::vector<std::uint32_t>(209)};
    kept.index.resize(form.kernels->keep_inside(
        box, points.range(), spans, {kept.a.data(), kept.f.data(), kept.z.data(), kept.index.data()}));
    EXPECT_EQ(kept.index, expected) << form.name;
    EXPECT_EQ(form.kernels->count_inside(box, points.range(), spans, 200), expected.size()) << form.name;
    const std::size_t some = form.kernels->count_inside(box, points.range(), spans, 0);
    EXPECT_GT(some, 0u) << form.name;
    EXPECT_LT(some, expected.size()) << form.name;
  }
}

TEST(PointKernels, MeetRowsWhereAllPairsOfPlanesLeaveSomething) {
  std::mt19937 random(10);
  std::uniform_real_distribution<float> unit(-1, 1);
  constexpr float kCell = 0.02f;
  for (const std::size_t size : {0, 1, 8, 30}) {
    std::pmr::vector<std::int32_t> y(size + kPointPadding), x(y), num_cells(y);
    for (std::size_t i = 0; i < size; ++i) {
      y[i] = static_cast<std::int32_t>(i) - 15;
      x[i] = static_cast<std::int32_t>(20 * unit(random));
      num_cells[i] = 1 + static_cast<std::int32_t>(i % 11);
    }
    RowLimits limits{};
    limits.cell_m = kCell;
    for (int k = 0; k < 4; ++k) {
      limits.slope[k] = unit(random);
      limits.least[k] = -0.2f + 0.1f * unit(random);
      limits.most[k] = 0.2f + 0.1f * unit(random);
    }
    for (const Form& form : forms()) {
      std::pmr::vector<std::int32_t> from(size + kPointPadding + 1, -7), to(from);
      form.kernels->meet_rows(limits, {y.data(), x.data(), num_cells.data(), size}, from.data(), to.data());
      EXPECT_EQ(from.back(), -7) << "writes beyond the room that is asked for";
      for (std::size_t i = 0; i < size; ++i) {
        const float middle = (static_cast<float>(y[i]) + 0.5f) * kCell;
        for (std::int32_t c = 0; c < num_cells[i]; ++c) {
          const float low = static_cast<float>(x[i] + c) * kCell;
          bool meets = true;
          float least = -1e9f, most = 1e9f;
          for (int k = 0; k < 4; ++k) {
            least = std::max(least, limits.least[k] - limits.slope[k] * middle);
            most = std::min(most, limits.most[k] - limits.slope[k] * middle);
          }
          meets = least <= most && low + kCell > least && low <= most;
          if (std::abs(low + kCell - least) < 1e-5f || std::abs(low - most) < 1e-5f) continue;
          EXPECT_EQ(c >= from[i] && c < to[i], meets) << form.name << " row " << i << " cell " << c;
        }
      }
    }
  }
}

TEST(PointKernels, KeepWhatIsNear) {
  for (const std::size_t size : {0, 1, 8, 15, 500}) {
    const Points points(size, 2);
    const float p[3] = {0.1f, -0.2f, 0.3f};
    std::pmr::vector<std::uint32_t> expected;
    for (std::size_t i = 0; i < size; ++i) {
      const double d =
          std::hypot(double{points.x[i]} - 0.1, double{points.y[i]} + 0.2, double{points.z[i]} - 0.3);
      if (d * d <= 0.5) expected.push_back(points.index[i]);
    }
    for (const Form& form : forms()) {
      std::pmr::vector<std::uint32_t> near(size + kPointPadding + 1, kUntouched);
      const std::size_t n = form.kernels->keep_near(p, 0.5f, points.range(), points.spans(), near.data());
      EXPECT_EQ(near.back(), kUntouched);
      near.resize(n);
      EXPECT_EQ(near, expected) << form.name << " " << size;
    }
  }
}

TEST(PointKernels, NumberCellsAlsoBelowZero) {
  const CellGrid grid{100, {-200, -200, -200}, 401, 401 * 401};
  for (const std::size_t size : {1, 8, 19, 300}) {
    Points points(size, 3);
    points.x[0] = -0.05f;  // a cell's face: floor, not truncation
    for (const Form& form : forms()) {
      std::pmr::vector<std::uint32_t> cells(size);
      form.kernels->number_cells(grid, points.x.data(), points.y.data(), points.z.data(), size, cells.data());
      for (std::size_t i = 0; i < size; ++i) {
        const auto cell = [](float v) { return static_cast<std::uint32_t>(std::floor(v * 100.0f) + 200); };
        EXPECT_EQ(cells[i], cell(points.x[i]) + 401 * cell(points.y[i]) + 401 * 401 * cell(points.z[i]))
            << form.name << " " << i;
      }
    }
  }
}

TEST(PointKernels, BoundsPassOverNaN) {
  for (const std::size_t size : {1, 8, 13, 100}) {
    Points points(size, 4);
    for (std::size_t i = 0; i < size; i += 3) points.x[i] = std::numeric_limits<float>::quiet_NaN();
    float expected_low = 0.1f, expected_high = 0.1f;
    for (std::size_t i = 0; i < size; ++i) {
      if (std::isnan(points.x[i])) continue;
      expected_low = std::min(expected_low, points.x[i]);
      expected_high = std::max(expected_high, points.x[i]);
    }
    for (const Form& form : forms()) {
      float low = 0.1f, high = 0.1f;
      form.kernels->extend_bounds(points.x.data(), size, low, high);
      EXPECT_EQ(low, expected_low) << form.name << " " << size;
      EXPECT_EQ(high, expected_high) << form.name << " " << size;
      low = 5;
      high = -5;
      form.kernels->extend_bounds(points.y.data(), size, low, high);
      EXPECT_EQ(low,
                *std::min_element(points.y.begin(), points.y.begin() + static_cast<std::ptrdiff_t>(size)));
      EXPECT_EQ(high,
                *std::max_element(points.y.begin(), points.y.begin() + static_cast<std::ptrdiff_t>(size)));
    }
  }
}

TEST(PointKernels, SumMoments) {
  const Points points(50, 6);
  std::pmr::vector<std::uint32_t> neighbors(40 + kPointPadding);
  for (std::size_t k = 0; k < neighbors.size(); ++k) neighbors[k] = static_cast<std::uint32_t>((k * 7) % 50);
  std::pmr::vector<NeighborList> lists;
  for (const std::uint32_t num : {0, 1, 3, 8, 9, 27, 40}) lists.push_back({num, num, neighbors.data()});
  const auto sums = [&](const PointKernels& kernels, std::size_t n) {
    MomentLanes out;
    std::memset(&out, 0xa5, sizeof out);
    kernels.sum_moments(points.x.data(), points.y.data(), points.z.data(), {lists.data(), n}, out);
    return out;
  };
  for (const std::size_t n : {std::size_t{0}, std::size_t{3}, lists.size()}) {
    const MomentLanes m = sums(portable_kernels(), n);
    for (std::size_t k = 0; k < kSolved; ++k) {
      double xx = 0, yz = 0, z = 0;
      const std::size_t num = k < n ? lists[k].size : 0;
      for (std::size_t i = 0; i < num; ++i) {
        const std::uint32_t j = neighbors[i], p = lists[k].point;
        const double dx = double{points.x[j]} - double{points.x[p]},
                     dy = double{points.y[j]} - double{points.y[p]},
                     dz = double{points.z[j]} - double{points.z[p]};
        xx += dx * dx;
        yz += dy * dz;
        z += dz;
      }
      EXPECT_NEAR(m.xx[k], xx, 1e-4);
      EXPECT_NEAR(m.yz[k], yz, 1e-4);
      EXPECT_NEAR(m.z[k], z, 1e-4);
      EXPECT_EQ(m.count[k], static_cast<float>(num));
    }
    for (const Form& form : forms()) {
      const MomentLanes other = sums(*form.kernels, n);
      EXPECT_EQ(std::memcmp(&other, &m, sizeof m), 0) << form.name << " " << n;
    }
  }
}

TEST(PointKernels, TheFastestFormIsChosen) {
  EXPECT_EQ(&point_kernels(), avx2_kernels() ? avx2_kernels() : &portable_kernels());
}

}  // namespace
}  // namespace graspd
