// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-bench-kernels: the loops over points, portable and AVX2, a block of points each time.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <memory_resource>
#include <random>
#include <string>
#include <vector>

#include "service/pipeline/point_kernels.hpp"

namespace graspd {
namespace {

constexpr std::size_t kNumPoints = 4096;  // 64 KB with their indices: what a core's own caches hold

/// Points all over a cube of 20 cm, and a band of them.
struct Block {
  std::pmr::vector<float> x, y, z;
  std::pmr::vector<std::uint32_t> index;
  std::pmr::vector<std::int32_t> object, own, bins;
  std::pmr::vector<float> a, f, depth;
  std::pmr::vector<std::uint32_t> out;

  Block() {
    constexpr std::size_t room = kNumPoints + kPointPadding;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> place(-0.1f, 0.1f);
    for (auto* values : {&x, &y, &z, &a, &f, &depth}) values->resize(room);
    for (auto* values : {&object, &own, &bins}) values->resize(room);
    index.resize(room);
    out.resize(room);
    for (std::size_t i = 0; i < room; ++i) {
      x[i] = place(random);
      y[i] = place(random);
      z[i] = place(random);
      index[i] = static_cast<std::uint32_t>(i);
      object[i] = static_cast<std::int32_t>(random() % 3);
      own[i] = object[i] == 1 ? 1 : 0;
    }
  }

  [[nodiscard]] PointRange points() const { return {x.data(), y.data(), z.data(), index.data(), kNumPoints}; }
  [[nodiscard]] BandPoints band() const { return {x.data(), z.data(), index.data(), kNumPoints}; }
};

/// A gripper's box, turned: about one in ten points is inside.
constexpr BoxTest kBox{{{0.8f, 0.6f, 0}, {-0.6f, 0.8f, 0}, {0, 0, 1}},
                       {0.01f, -0.02f, 0.005f},
                       {-0.04f, -0.05f, -0.05f},
                       {0.04f, 0.05f, 0.05f}};

constexpr PointSpan kWhole{0, kNumPoints};

void keep_inside(const PointKernels& kernels, Block& b) {
  benchmark::DoNotOptimize(kernels.keep_inside(kBox, b.points(), {&kWhole, 1},
                                               {b.a.data(), b.f.data(), b.depth.data(), b.out.data()}));
}

void count_inside(const PointKernels& kernels, Block& b) {
  benchmark::DoNotOptimize(kernels.count_inside(kBox, b.points(), {&kWhole, 1}, kNumPoints));
}

void keep_near(const PointKernels& kernels, Block& b) {
  constexpr float kCenter[3] = {0.01f, 0, -0.02f};
  benchmark::DoNotOptimize(kernels.keep_near(kCenter, 0.05f * 0.05f, b.points(), {&kWhole, 1}, b.out.data()));
}

void sum_moments(const PointKernels& kernels, Block& b) {
  const NeighborList list{0, kNumPoints, b.index.data()};
  MomentLanes sums;
  kernels.sum_moments(b.x.data(), b.y.data(), b.z.data(), {&list, 1}, sums);
  benchmark::DoNotOptimize(sums.zz[0]);
}

void extend_bounds(const PointKernels& kernels, Block& b) {
  float low = INFINITY, high = -INFINITY;
  kernels.extend_bounds(b.x.data(), kNumPoints, low, high);
  benchmark::DoNotOptimize(low);
  benchmark::DoNotOptimize(high);
}

void number_cells(const PointKernels& kernels, Block& b) {
  constexpr CellGrid kGrid{1 / 0.009f, {-12, -12, -12}, 26, 26 * 26};
  kernels.number_cells(kGrid, b.x.data(), b.y.data(), b.z.data(), kNumPoints, b.out.data());
  benchmark::DoNotOptimize(b.out.data());
}

void tag_band(const PointKernels& kernels, Block& b) {
  const BandTags tags{b.object.data(), b.index.data(), 1, -0.1f, 0.003f, 67};
  kernels.tag_band(tags, b.band(), b.own.data(), b.bins.data());
  benchmark::DoNotOptimize(b.bins.data());
}

void keep_depths(const PointKernels& kernels, Block& b) {
  benchmark::DoNotOptimize(
      kernels.keep_depths(b.band(), b.own.data(), {-0.04f, 0.04f, -0.05f}, b.depth.data()));
}

using Kernel = void (*)(const PointKernels&, Block&);

void run(benchmark::State& state, const PointKernels& kernels, Kernel kernel) {
  Block block;
  for (auto _ : state) {
    kernel(kernels, block);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kNumPoints));
}

void add(const std::string& name, Kernel kernel) {
  benchmark::RegisterBenchmark((name + "/portable").c_str(), run, portable_kernels(), kernel);
  if (const PointKernels* avx2 = avx2_kernels())
    benchmark::RegisterBenchmark((name + "/avx2").c_str(), run, *avx2, kernel);
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  using namespace graspd;
  add("keep_inside", keep_inside);
  add("count_inside", count_inside);
  add("keep_near", keep_near);
  add("sum_moments", sum_moments);
  add("extend_bounds", extend_bounds);
  add("number_cells", number_cells);
  add("tag_band", tag_band);
  add("keep_depths", keep_depths);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
