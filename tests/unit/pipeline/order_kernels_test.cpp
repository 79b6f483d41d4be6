// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Both forms of the kernels that points are brought into order and cells put together with against the
// definition.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/unit/pipeline/kernel_forms.hpp"

namespace graspd {
namespace {

/// Keys of which the share is like the one before.
std::vector<std::uint32_t> keys_in_runs(std::size_t n, double share) {
  std::mt19937 random(static_cast<std::uint32_t>(n));
  std::bernoulli_distribution goes_on(share);
  std::vector<std::uint32_t> keys(n);
  for (std::size_t i = 0; i < n; ++i)
    keys[i] = i > 0 && goes_on(random) ? keys[i - 1] : static_cast<std::uint32_t>(random() % 3 + 0xfffffffd);
  return keys;
}

TEST(OrderKernels, FindRunsInAPartAndWriteNoMore) {
  for (const double share : {0.0, 0.5, 0.95})
    for (const std::size_t end : {3, 4, 11, 12, 40, 400}) {
      const std::vector<std::uint32_t> keys = keys_in_runs(end + 10, share);
      constexpr std::size_t kBegin = 3, kFirst = 2;
      std::vector<std::uint32_t> starts;
      for (std::size_t i = kBegin; i < end; ++i)
        if (i == kBegin || keys[i] != keys[i - 1]) starts.push_back(static_cast<std::uint32_t>(i));
      for (const Form& form : forms()) {
        if (end > kBegin) {
          EXPECT_EQ(form.kernels->count_changes(keys.data() + kBegin, end - kBegin), starts.size() - 1)
              << form.name;
        }
        std::vector<CellRun<std::uint32_t>> list(kFirst + starts.size() + 1, {7, kUntouched});
        std::vector<std::uint32_t> found(list.size(), kUntouched);
        form.kernels->write_runs(keys.data(), kBegin, end,
                                 {list.data(), found.data(), kFirst, kFirst + starts.size()});
        for (const std::size_t outside : {std::size_t{0}, kFirst - 1, list.size() - 1}) {
          EXPECT_EQ(found[outside], kUntouched) << form.name;
          EXPECT_EQ(list[outside].number, kUntouched) << form.name;
        }
        for (std::size_t k = 0; k < starts.size(); ++k) {
          ASSERT_EQ(found[kFirst + k], starts[k]) << form.name << " " << share << " " << end;
          ASSERT_EQ(list[kFirst + k].key, keys[starts[k]]);
          ASSERT_EQ(list[kFirst + k].number, kFirst + k);
        }
      }
    }
}

struct Copied {
  std::vector<float> x, y, z;
  std::vector<std::uint32_t> index;

  explicit Copied(std::size_t room) : x(room), y(room), z(room), index(room + 1, kUntouched) {}
  [[nodiscard]] LocalOutput out() { return {x.data(), y.data(), z.data(), index.data()}; }
};

void expect_copied(const Copied& copied, const Points& points, const std::vector<std::uint32_t>& expected) {
  EXPECT_EQ(copied.index.back(), kUntouched) << "writes beyond the room that is asked for";
  for (std::size_t k = 0; k < expected.size(); ++k) {
    ASSERT_EQ(copied.index[k], expected[k]);
    ASSERT_EQ(copied.x[k], points.x[expected[k]]);
    ASSERT_EQ(copied.y[k], points.y[expected[k]]);
    ASSERT_EQ(copied.z[k], points.z[expected[k]]);
  }
}

TEST(OrderKernels, CopyPoints) {
  const Points points(100);
  const PointRange range{points.x.data(), points.y.data(), points.z.data(), nullptr, 100};
  for (const std::size_t size : {0, 5, 8, 30}) {
    std::vector<std::uint32_t> some(size);
    for (std::size_t k = 0; k < size; ++k) some[k] = static_cast<std::uint32_t>(k * 37 % 100);
    for (const Form& form : forms()) {
      Copied at(size);
      form.kernels->copy_at(range, some, at.out());
      expect_copied(at, points, some);
      Copied without(size);
      LocalOutput out = without.out();
      out.index = nullptr;
      form.kernels->copy_at(range, some, out);
      EXPECT_EQ(without.x, at.x) << form.name;
    }
  }
}

TEST(OrderKernels, WriteCellsInAPartAndNoMore) {
  // Sorted runs of three cells, whose numbers are in no order; a part of them that begins within a cell.
  const std::vector<CellRun<std::uint32_t>> list{{4, 2}, {4, 0},          {4, 3},
                                                 {7, 1}, {0xfffffff0, 4}, {0xfffffff0, 5}};
  const std::vector<std::uint32_t> firsts{0, 3, 20, 21, 30, 31, 40};
  constexpr std::size_t kBegin = 1;
  constexpr std::uint32_t kFirst = 5;
  std::vector<std::uint32_t> expected;
  for (std::size_t r = kBegin; r < list.size(); ++r)
    for (std::uint32_t i = firsts[list[r].number]; i < firsts[list[r].number + 1]; ++i) expected.push_back(i);
  for (const Form& form : forms()) {
    std::vector<std::int64_t> keys(3, -1);
    std::vector<std::uint32_t> starts(3, kUntouched), points(kFirst + expected.size() + 1, kUntouched);
    form.kernels->write_cells(list.data(), kBegin, list.size(), firsts.data(),
                              {keys.data(), starts.data(), points.data(), kFirst,
                               kFirst + static_cast<std::uint32_t>(expected.size())});
    EXPECT_EQ(keys, (std::vector<std::int64_t>{7, 0xfffffff0, -1})) << form.name;
    EXPECT_EQ(starts, (std::vector<std::uint32_t>{kFirst + 3 + 9, kFirst + 3 + 9 + 17, kUntouched}))
        << form.name;
    EXPECT_EQ(points[kFirst - 1], kUntouched);
    EXPECT_EQ(points.back(), kUntouched) << form.name;
    for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_EQ(points[kFirst + k], expected[k]) << form.name;
  }
}

/// Cells of many sizes, some of whose points come several times.
struct Cells {
  Points points{300};
  std::vector<std::uint32_t> index, starts{0};

  explicit Cells(std::size_t n) {
    std::mt19937 random(static_cast<std::uint32_t>(n));
    for (std::size_t c = 0; c < n; ++c) {
      const std::size_t size = c % 5 == 4 ? 20 : 1 + random() % 4;
      for (std::size_t k = 0; k < size; ++k) index.push_back(static_cast<std::uint32_t>(random() % 300));
      starts.push_back(static_cast<std::uint32_t>(index.size()));
    }
  }
  [[nodiscard]] std::size_t size() const { return starts.size() - 1; }
  [[nodiscard]] CellPoints of() const {
    return {points.x.data(), points.y.data(), points.z.data(), index.data(), starts.data(), size()};
  }
  [[nodiscard]] std::vector<std::uint32_t> cell(std::size_t c) const {
    return {index.begin() + starts[c], index.begin() + starts[c + 1]};
  }
  [[nodiscard]] Eigen::Vector3d point(std::uint32_t i) const {
    return Eigen::Vector3f(points.x[i], points.y[i], points.z[i]).cast<double>();
  }
  [[nodiscard]] Eigen::Vector3d mean(std::size_t c) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t i : cell(c)) sum += point(i);
    return sum / static_cast<double>(cell(c).size());
  }
};

TEST(CellKernels, MeansAndWhatIsNearestToThem) {
  for (const std::size_t size : {0, 1, 8, 9, 40}) {
    const Cells cells(size);
    std::vector<float> expected[3];
    std::vector<std::uint32_t> expected_middles;
    for (const Form& form : forms()) {
      std::vector<float> mean[3];
      for (auto& v : mean) v.resize(size);
      form.kernels->set_means(cells.of(), mean[0].data(), mean[1].data(), mean[2].data());
      std::vector<std::uint32_t> middles(size);
      form.kernels->find_middles(cells.of(), middles.data());
      for (std::size_t c = 0; c < size; ++c) {
        const Eigen::Vector3d true_mean = cells.mean(c);
        EXPECT_LT((Eigen::Vector3f(mean[0][c], mean[1][c], mean[2][c]).cast<double>() - true_mean).norm(),
                  1e-6);
        const double distance = (cells.point(middles[c]) - true_mean).norm();
        for (const std::uint32_t i : cells.cell(c))
          EXPECT_LE(distance, (cells.point(i) - true_mean).norm() + 1e-6);
      }
      if (form.kernels == &portable_kernels()) {
        expected_middles = middles;
        for (int axis = 0; axis < 3; ++axis) expected[axis] = mean[axis];
      }
      EXPECT_EQ(middles, expected_middles) << form.name << " " << size;
      for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(mean[axis], expected[axis]) << form.name << " " << size;
    }
  }
}

}  // namespace
}  // namespace graspd
