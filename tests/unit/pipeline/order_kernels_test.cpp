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

using Run32 = CellRun<std::uint32_t>;

TEST(OrderKernels, FindRunsInAPartAndWriteNoMore) {
  for (const double share : {0.0, 0.5, 0.95, 1.0})
    for (const std::size_t end : {3, 4, 11, 12, 40, 400, 1023, 1024, 1025, 1030, 5000}) {
      const std::vector<std::uint32_t> keys = keys_in_runs(end + 10, share);
      constexpr std::size_t kBegin = 3, kFirst = 2;
      std::vector<std::size_t> starts;
      std::size_t num_changes = 0;
      for (std::size_t i = kBegin; i < end; ++i) {
        if (i == kBegin || keys[i] != keys[i - 1] || i % 1024 == 0) starts.push_back(i);
        num_changes += i > kBegin && keys[i] != keys[i - 1] ? 1 : 0;
      }
      for (const Form& form : forms()) {
        if (end > kBegin) {
          EXPECT_EQ(form.kernels->count_changes(keys.data() + kBegin, end - kBegin), num_changes)
              << form.name;
        }
        const Run32 untouched(kUntouched, 7, 8);
        std::vector<Run32> list(kFirst + starts.size() + 1, untouched);
        form.kernels->write_runs(keys.data(), kBegin, end, list.data() + kFirst, starts.size());
        for (const std::size_t outside : {std::size_t{0}, kFirst - 1, list.size() - 1}) {
          EXPECT_EQ(list[outside].key, untouched.key) << form.name;
          EXPECT_EQ(list[outside].points, untouched.points) << form.name;
        }
        for (std::size_t k = 0; k < starts.size(); ++k) {
          ASSERT_EQ(list[kFirst + k].key, keys[starts[k]]) << form.name << " " << share << " " << end;
          ASSERT_EQ(list[kFirst + k].first(), starts[k]) << form.name << " " << share << " " << end;
          ASSERT_EQ(list[kFirst + k].size(), (k + 1 < starts.size() ? starts[k + 1] : end) - starts[k]);
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

/// Sorted runs of a cloud's points, of up to so many each.
std::vector<Run32> sorted_runs(std::size_t n, std::size_t most_points) {
  std::mt19937 random(static_cast<std::uint32_t>(n));
  std::vector<std::size_t> starts{0};
  for (std::size_t r = 0; r < n; ++r) starts.push_back(starts.back() + 1 + random() % most_points);
  std::vector<Run32> list;
  std::uint32_t key = 0x7ffffff0;  // further ones are negative to whoever takes them for signed
  for (std::size_t r = 0; r < n; ++r) {
    const std::size_t at = r * 7 % n;  // in no order
    list.emplace_back(key, starts[at], starts[at + 1]);
    if (random() % 2 != 0) key += r % 50 == 49 ? 0x10000000 : 7;
  }
  return list;
}

/// What is written for a part of them.
struct Written {
  std::vector<std::int64_t> keys;
  std::vector<std::uint32_t> starts, points;
  bool operator==(const Written&) const = default;
};

constexpr std::uint32_t kFirstPoint = 5;

Written expected_cells(const std::vector<Run32>& list, std::size_t begin) {
  Written written;
  for (std::size_t r = begin; r < list.size(); ++r) {
    if (r == 0 || list[r].key != list[r - 1].key) {
      written.keys.push_back(list[r].key);
      written.starts.push_back(kFirstPoint + static_cast<std::uint32_t>(written.points.size()));
    }
    for (std::uint32_t k = 0; k < list[r].size(); ++k) written.points.push_back(list[r].first() + k);
  }
  return written;
}

TEST(OrderKernels, WriteCellsInAPartAndNoMore) {
  for (const std::size_t most_points : {1, 4, 9, 40})
    for (const std::size_t size : {1, 2, 8, 9, 17, 41, 300})
      for (const std::size_t begin : {std::size_t{0}, std::size_t{1}, size / 2}) {
        const std::vector<Run32> list = sorted_runs(size, most_points);
        const Written expected = expected_cells(list, begin);
        for (const Form& form : forms()) {
          const CellCounts counts = form.kernels->count_cells(list.data(), begin, size);
          ASSERT_EQ(counts.cells, expected.keys.size()) << form.name << " " << size << " " << begin;
          ASSERT_EQ(counts.points, expected.points.size()) << form.name << " " << size << " " << begin;
          Written written{std::vector<std::int64_t>(counts.cells + 1, -1),
                          std::vector<std::uint32_t>(counts.cells + 1, kUntouched),
                          std::vector<std::uint32_t>(kFirstPoint + counts.points + 1, kUntouched)};
          form.kernels->write_cells(list.data(), begin, size,
                                    {written.keys.data(), written.starts.data(), written.points.data(),
                                     counts.cells, kFirstPoint, kFirstPoint + counts.points});
          EXPECT_EQ(written.keys.back(), -1) << form.name;
          EXPECT_EQ(written.starts.back(), kUntouched) << form.name;
          EXPECT_EQ(written.points.back(), kUntouched) << form.name;
          EXPECT_EQ(written.points[kFirstPoint - 1], kUntouched) << form.name;
          written.keys.pop_back();
          written.starts.pop_back();
          written.points.pop_back();
          written.points.erase(written.points.begin(), written.points.begin() + kFirstPoint);
          EXPECT_EQ(written, expected) << form.name << " " << most_points << " " << size << " " << begin;
        }
      }
}

TEST(OrderKernels, WriteTheCellsThatBeginInAPart) {
  // Sorted runs of three cells; a part of them that begins within a cell.
  const std::vector<Run32> list{{4, 20, 21},          {4, 0, 3},           {4, 21, 30}, {7, 3, 20},
                                {0xfffffff0, 30, 31}, {0xfffffff0, 31, 40}};
  constexpr std::size_t kBegin = 1;
  std::vector<std::uint32_t> expected;
  for (std::size_t r = kBegin; r < list.size(); ++r)
    for (std::uint32_t k = 0; k < list[r].size(); ++k) expected.push_back(list[r].first() + k);
  for (const Form& form : forms()) {
    std::vector<std::int64_t> keys(3, -1);
    std::vector<std::uint32_t> starts(3, kUntouched), points(kFirstPoint + expected.size() + 1, kUntouched);
    form.kernels->write_cells(list.data(), kBegin, list.size(),
                              {keys.data(), starts.data(), points.data(), 2, kFirstPoint,
                               kFirstPoint + static_cast<std::uint32_t>(expected.size())});
    EXPECT_EQ(keys, (std::vector<std::int64_t>{7, 0xfffffff0, -1})) << form.name;
    EXPECT_EQ(starts, (std::vector<std::uint32_t>{kFirstPoint + 3 + 9, kFirstPoint + 3 + 9 + 17, kUntouched}))
        << form.name;
    EXPECT_EQ(points[kFirstPoint - 1], kUntouched);
    EXPECT_EQ(points.back(), kUntouched) << form.name;
    for (std::size_t k = 0; k < expected.size(); ++k)
      EXPECT_EQ(points[kFirstPoint + k], expected[k]) << form.name;
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
