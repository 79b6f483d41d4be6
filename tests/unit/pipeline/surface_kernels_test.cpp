// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Both forms of the kernels that frames are filtered and surfaces are found with against the definition, and
// against each other to the bit.
#include <gtest/gtest.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/unit/pipeline/kernel_forms.hpp"

namespace graspd {
namespace {

/// Unit vectors about an axis, and some indices of them; the padding of the indices is valid, too.
struct Neighbors {
  Points normals;
  std::vector<std::uint32_t> indices;
  std::size_t size;

  explicit Neighbors(std::size_t n) : normals(200, 5), indices(n + kPointPadding), size(n) {
    for (std::size_t i = 0; i < normals.size; ++i) {
      normals.z[i] = 2;
      const float length = std::hypot(normals.x[i], normals.y[i], normals.z[i]);
      for (std::pmr::vector<float>* v : {&normals.x, &normals.y, &normals.z}) (*v)[i] /= length;
    }
    std::mt19937 random(static_cast<std::uint32_t>(n) + 1);
    for (std::uint32_t& i : indices) i = static_cast<std::uint32_t>(random() % normals.size);
  }
  [[nodiscard]] NormalArrays arrays() const { return {normals.x.data(), normals.y.data(), normals.z.data()}; }
  [[nodiscard]] float cosine(std::uint32_t a, std::uint32_t b) const {
    return normals.x[a] * normals.x[b] + normals.y[a] * normals.y[b] + normals.z[a] * normals.z[b];
  }
};

WorkspaceTest workspace() {
  return {{{{0.8f, 0.6f, 0}, {-0.6f, 0.8f, 0}, {0, 0, 1}},
           {0.1f, 0, 0},
           {-0.7f, -0.6f, -0.5f},
           {0.8f, 0.7f, 0.9f}},
          {0.1f, 0.2f, -0.3f},
          0.04f,
          0.9f};
}

TEST(FilterKernels, TestTheWorkspaceAndCopyWhatIsInIt) {
  const WorkspaceTest test = workspace();
  for (const std::size_t size : {0, 1, 7, 8, 9, 63, 64, 65, 500}) {
    Points points(size, 9);
    for (std::size_t i = 0; i < size; i += 5) points.y[i] = std::array{NAN, INFINITY}[i % 2];
    std::vector<std::uint8_t> expected((size + 7) / 8);
    std::vector<std::uint32_t> chosen;
    for (std::size_t i = 0; i < size; ++i) {
      const Eigen::Vector3f p(points.x[i], points.y[i], points.z[i]);
      const float squared = (p - Eigen::Vector3f(0.1f, 0.2f, -0.3f)).squaredNorm();
      const Eigen::Vector3f local(0.8f * p.x() + 0.6f * p.y() + 0.1f, -0.6f * p.x() + 0.8f * p.y(), p.z());
      if (!p.allFinite() || squared < 0.04f || squared > 0.9f) continue;
      if ((local.array() < Eigen::Array3f(-0.7f, -0.6f, -0.5f)).any()) continue;
      if ((local.array() > Eigen::Array3f(0.8f, 0.7f, 0.9f)).any()) continue;
      expected[i / 8] = static_cast<std::uint8_t>(expected[i / 8] | (1 << (i % 8)));
      chosen.push_back(static_cast<std::uint32_t>(i));
    }
    for (const Form& form : forms()) {
      std::vector<std::uint8_t> masks(expected.size() + 1, 0xa5);
      const std::size_t num_finite = form.kernels->test_workspace(test, points.x.data(), points.y.data(),
                                                                  points.z.data(), size, masks.data());
      EXPECT_EQ(num_finite, size - (size + 4) / 5) << form.name;
      EXPECT_EQ(masks.back(), 0xa5);
      masks.pop_back();
      EXPECT_EQ(masks, expected) << form.name << " " << size;
      const std::size_t n = chosen.size();
      std::vector<float> x(n + 1, 7), y(n + 1, 7), z(n + 1, 7);
      std::vector<std::uint32_t> position(n + 1, kUntouched);
      for (std::uint32_t* positions : {position.data(), static_cast<std::uint32_t*>(nullptr)})
        form.kernels->copy_chosen(points.x.data(), points.y.data(), points.z.data(), masks.data(), size,
                                  {x.data(), y.data(), z.data(), positions, n, 40});
      for (std::size_t k = 0; k < n; ++k) {
        EXPECT_EQ(x[k], points.x[chosen[k]]);
        EXPECT_EQ(y[k], points.y[chosen[k]]);
        EXPECT_EQ(z[k], points.z[chosen[k]]);
        EXPECT_EQ(position[k], chosen[k] + 40) << form.name;
      }
      EXPECT_EQ(position.back(), kUntouched) << "writes beyond the room";
      EXPECT_EQ(x.back() + y.back() + z.back(), 21) << "writes beyond the room";
    }
  }
}

TEST(SurfaceKernels, CopyWhatIsInTheBoxOfTheAxes) {
  const float min[3] = {-0.5f, -0.25f, -1}, max[3] = {0.5f, 0.75f, 0.5f};
  for (const std::size_t size : {0, 1, 7, 8, 9, 500}) {
    const Points points(size, 4);
    for (const Form& form : forms()) {
      const std::size_t room = size + kPointPadding;
      std::vector<float> x(room), y(room), z(room);
      std::vector<std::uint32_t> index(room + 1, kUntouched);
      const std::size_t n = form.kernels->copy_inside(min, max, points.range(), points.spans(),
                                                      {x.data(), y.data(), z.data(), index.data()});
      EXPECT_EQ(index.back(), kUntouched);
      std::size_t k = 0;
      for (std::size_t i = 0; i < size; ++i) {
        if (points.x[i] < min[0] || points.x[i] > max[0] || points.y[i] < min[1] || points.y[i] > max[1] ||
            points.z[i] < min[2] || points.z[i] > max[2])
          continue;
        ASSERT_LT(k, n) << form.name;
        EXPECT_EQ(x[k], points.x[i]);
        EXPECT_EQ(y[k], points.y[i]);
        EXPECT_EQ(z[k], points.z[i]);
        EXPECT_EQ(index[k++], points.index[i]);
      }
      EXPECT_EQ(k, n) << form.name << " " << size;
    }
  }
}

TEST(SurfaceKernels, SolvePlanesOfKnownNormal) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> unit(-1, 1);
  MomentLanes m{};
  std::array<Eigen::Vector3f, kSolved> normal;
  for (std::size_t k = 0; k < kSolved; ++k) {
    normal[k] = Eigen::Vector3f(unit(random), unit(random), 1.5f).normalized();
    const std::size_t num = k == 0 ? 2 : k == 1 ? 0 : 20 + k;  // lane 0: two points are no plane
    for (std::size_t i = 0; i < num; ++i) {
      Eigen::Vector3f p(unit(random), unit(random), unit(random));
      p -= normal[k] * normal[k].dot(p);
      m.x[k] += p.x(), m.y[k] += p.y(), m.z[k] += p.z();
      m.xx[k] += p.x() * p.x(), m.xy[k] += p.x() * p.y(), m.xz[k] += p.x() * p.z();
      m.yy[k] += p.y() * p.y(), m.yz[k] += p.y() * p.z(), m.zz[k] += p.z() * p.z();
    }
    m.count[k] = static_cast<float>(num);
  }
  for (const Form& form : forms()) {
    NormalLanes n;
    form.kernels->solve_planes(m, n);
    for (std::size_t k = 0; k < kSolved; ++k) {
      const Eigen::Vector3f found(n.x[k], n.y[k], n.z[k]);
      if (k < 2)
        EXPECT_EQ(found, Eigen::Vector3f::Zero()) << form.name;
      else
        EXPECT_NEAR(std::abs(found.dot(normal[k])), 1, 1e-5) << form.name << " " << k;
    }
  }
}

TEST(SurfaceKernels, SolvePlanesToTheSameBits) {
  if (!avx2_kernels()) GTEST_SKIP() << "this processor has the portable form alone";
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  for (int round = 0; round < 2000; ++round) {
    // Of points in space, near a plane, near a line, at one place; and sums that no points have.
    const float thin = std::array{1.0f, 1e-2f, 1e-5f, 0.0f}[static_cast<std::size_t>(round % 4)];
    MomentLanes m{};
    for (std::size_t k = 0; k < kSolved; ++k) {
      m.count[k] = static_cast<float>(k + static_cast<std::size_t>(round % 5));
      for (std::size_t i = 0; i < k + static_cast<std::size_t>(round % 5); ++i) {
        const float x = normal(random), y = round % 3 == 0 ? thin * normal(random) : normal(random),
                    z = thin * normal(random);
        m.x[k] += x, m.y[k] += y, m.z[k] += z;
        m.xx[k] += x * x, m.xy[k] += x * y, m.xz[k] += x * z, m.yy[k] += y * y, m.yz[k] += y * z,
            m.zz[k] += z * z;
      }
      if (round % 7 == 0) m.yy[k] = -m.yy[k];
      if (round % 11 == 0) m.xx[k] *= 1e30f;
    }
    NormalLanes a, b;
    portable_kernels().solve_planes(m, a);
    avx2_kernels()->solve_planes(m, b);
    const auto same = [](float u, float v) {
      return std::bit_cast<std::uint32_t>(u) == std::bit_cast<std::uint32_t>(v) ||
             (std::isnan(u) && std::isnan(v));
    };
    for (std::size_t k = 0; k < kSolved; ++k)
      ASSERT_TRUE(same(a.x[k], b.x[k]) && same(a.y[k], b.y[k]) && same(a.z[k], b.z[k])) << round << " " << k;
  }
}

TEST(SurfaceKernels, CountThePointsOnAPlane) {
  for (const std::size_t size : {0, 1, 7, 8, 9, 200}) {
    const Points points(size, 8);
    const Neighbors neighbors(0);
    const PlaneTest test{{0.6f, 0, 0.8f}, 0.1f, 0.1f, 0.75f};
    int expected = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const float height = 0.6f * points.x[i] + 0.8f * points.z[i] + 0.1f;
      const float cosine = 0.6f * neighbors.normals.x[i] + 0.8f * neighbors.normals.z[i];
      expected += std::abs(height) < 0.1f && cosine > 0.75f ? 1 : 0;
    }
    for (const Form& form : forms())
      EXPECT_EQ(form.kernels->count_on_plane(
                    test, {points.x.data(), points.y.data(), points.z.data(), neighbors.arrays(), size}),
                expected)
          << form.name << " " << size;
  }
}

TEST(SurfaceKernels, CountNormalsThatPointElsewhere) {
  for (const std::size_t size : {0, 1, 8, 13, 64}) {
    const Neighbors in(size);
    std::size_t expected = 0;
    for (std::size_t k = 0; k < size; ++k) expected += in.cosine(3, in.indices[k]) < 0.8f ? 1 : 0;
    for (const Form& form : forms())
      EXPECT_EQ(form.kernels->count_bent(in.arrays(), 3, 0.8f, in.indices.data(), size), expected)
          << form.name << " " << size;
  }
}

TEST(SurfaceKernels, FindLinksWithinARangeToOtherSets) {
  std::vector<float> least(200, 0.7f);
  std::vector<std::uint32_t> parent(200);
  for (std::uint32_t i = 0; i < 200; ++i) {
    if (i % 3 == 0) least[i] = 0.9f;
    if (i % 5 == 0) least[i] = 2;
    parent[i] = i % 4 == 0 ? 7 : i;
  }
  std::size_t num_links = 0;
  for (const std::size_t size : {0, 1, 8, 13, 64}) {
    const Neighbors in(size);
    for (const std::uint32_t s : {9u, 11u}) {
      const LinkTest test{in.arrays(), least.data(), parent.data()};
      const LinkPlace place{s, 7, 20, 150};
      std::vector<std::uint32_t> expected;
      bool any_beyond = false;
      for (std::size_t k = 0; k < size; ++k) {
        const std::uint32_t p = in.indices[k];
        any_beyond = any_beyond || p >= 150;
        if (p >= 20 && p < 150 && parent[p] != 7 && in.cosine(s, p) > std::max(least[s], least[p]))
          expected.push_back(p);
      }
      num_links += expected.size();
      for (const Form& form : forms()) {
        std::vector<std::uint32_t> found(size + kPointPadding + 1, kUntouched);
        const FoundLinks links = form.kernels->find_links(test, place, in.indices.data(), size, found.data());
        EXPECT_EQ(found.back(), kUntouched);
        EXPECT_EQ(links.any_beyond, any_beyond) << form.name << " " << size;
        found.resize(links.num);
        EXPECT_EQ(found, expected) << form.name << " " << size;
      }
    }
  }
  EXPECT_GT(num_links, 10u);
}

TEST(SurfaceKernels, TellWhetherAnyHasAnotherValueAndWhichAreAbove) {
  for (const std::size_t size : {0, 1, 8, 13, 64}) {
    const Neighbors in(size);
    std::vector<std::int32_t> values(200, -3);
    for (const Form& form : forms()) {
      EXPECT_FALSE(form.kernels->any_other(values.data(), -3, in.indices.data(), size)) << form.name;
      for (std::size_t k = 0; k < size; ++k) {
        std::vector<std::int32_t> others = values;
        others[in.indices[k]] = static_cast<std::int32_t>(k) - 1;
        EXPECT_TRUE(form.kernels->any_other(others.data(), -3, in.indices.data(), size)) << form.name;
      }
      EXPECT_EQ(form.kernels->any_other(values.data(), 0, in.indices.data(), size), size > 0) << form.name;
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::int32_t>(i * 7 % 50) - 25;
      std::vector<std::uint32_t> expected, found(size + kPointPadding + 1, kUntouched);
      for (std::size_t k = 0; k < size; ++k)
        if (values[in.indices[k]] > 10) expected.push_back(in.indices[k]);
      const std::size_t n =
          form.kernels->list_above(values.data(), 10, in.indices.data(), size, found.data());
      EXPECT_EQ(found.back(), kUntouched);
      found.resize(n);
      EXPECT_EQ(found, expected) << form.name << " " << size;
      values.assign(200, -3);
    }
  }
}

TEST(SurfaceKernels, ListMembersAndWhatIsNotMarked) {
  for (const std::size_t size : {0, 1, 7, 8, 9, 31, 32, 33, 300}) {
    std::mt19937 random(static_cast<std::uint32_t>(size));
    std::vector<std::int32_t> values(size);
    std::vector<std::uint8_t> marks(size);
    std::vector<std::uint32_t> members;
    for (std::uint32_t i = 0; i < size; ++i) {
      // In parts, of which some are all alike.
      const bool is_in = i / 16 % 3 == 0 ? random() % 2 == 0 : i / 16 % 3 == 1;
      values[i] = static_cast<std::int32_t>(random() % 4) - (is_in ? 0 : 5);
      marks[i] = is_in ? 0 : static_cast<std::uint8_t>(1 + random() % 255);
      if (is_in) members.push_back(i);
    }
    for (const Form& form : forms()) {
      std::vector<std::uint32_t> found(size + kPointPadding + 1, kUntouched);
      found.resize(form.kernels->list_members(values.data(), size, found.data()));
      EXPECT_EQ(found, members) << form.name << " " << size;
      found.assign(size + kPointPadding + 1, kUntouched);
      const std::size_t n = form.kernels->list_unmarked(marks.data(), size, found.data());
      EXPECT_EQ(found.back(), kUntouched);
      found.resize(n);
      EXPECT_EQ(found, members) << form.name << " " << size;
    }
  }
}

}  // namespace
}  // namespace graspd
