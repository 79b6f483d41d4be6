// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/workspace_filter.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>

#include "service/pipeline/point_kernels.hpp"

namespace graspd {
namespace {

WorkspaceTest workspace_test(const Eigen::Vector3f& viewpoint, const WorkspaceFilterConfig& config) {
  WorkspaceTest test;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) test.box.to_local[i][j] = config.T_box_cloud.linear()(i, j);
    test.box.shift[i] = config.T_box_cloud.translation()[i];
    test.box.min[i] = config.min_m[i];
    test.box.max[i] = config.max_m[i];
    test.origin[i] = viewpoint[i];
  }
  test.least_squared = config.min_range_m * config.min_range_m;
  test.most_squared = config.max_range_m * config.max_range_m;
  return test;
}

constexpr std::size_t kChunk = 1 << 15;

/// Points that are looked at together.
struct Chunk {
  std::size_t num_finite = 0, num_inside = 0;
  std::size_t first = 0;  // of those inside, among those of all chunks
};

std::size_t count_bits(std::span<const std::uint8_t> bytes) {
  std::size_t num = 0;
  for (; bytes.size() >= sizeof(std::uint64_t); bytes = bytes.subspan(sizeof(std::uint64_t))) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), sizeof(word));
    num += static_cast<std::size_t>(std::popcount(word));
  }
  for (const std::uint8_t byte : bytes) num += static_cast<std::size_t>(std::popcount(byte));
  return num;
}

bool is_image(const PointCloud& cloud) {
  return cloud.width > 1 && cloud.height > 1 &&
         static_cast<std::size_t>(cloud.width) * static_cast<std::size_t>(cloud.height) == cloud.size();
}

}  // namespace

std::optional<ConfigProblem> WorkspaceFilterConfig::validate() const {
  if (!(min_m.array() < max_m.array()).all())
    return ConfigProblem{"max_m", "the workspace is empty: expected more than min_m on each axis"};
  if (min_range_m >= max_range_m)
    return ConfigProblem{"max_range_m", "the range is empty: expected more than min_range_m"};
  return std::nullopt;
}

WorkspaceResult filter_workspace(const PointCloud& cloud, const WorkspaceFilterConfig& config) {
  const std::size_t n = cloud.size();
  const PointKernels& kernels = point_kernels();
  const WorkspaceTest test = workspace_test(cloud.viewpoint, config);
  RawVector<std::uint8_t> masks((n + 7) / 8);
  std::pmr::vector<Chunk> chunks((n + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    const std::size_t begin = c * kChunk, size = std::min(kChunk, n - begin);
    std::uint8_t* mask = masks.data() + begin / 8;
    chunks[c].num_finite = kernels.test_workspace(test, cloud.x.data() + begin, cloud.y.data() + begin,
                                                  cloud.z.data() + begin, size, mask);
    chunks[c].num_inside = count_bits({mask, (size + 7) / 8});
  });
  WorkspaceResult result;
  std::size_t num_inside = 0;
  for (Chunk& chunk : chunks) {
    chunk.first = num_inside;
    num_inside += chunk.num_inside;
    result.num_finite += chunk.num_finite;
  }
  PointCloud& kept = result.cloud = unorganized_cloud(num_inside, cloud.viewpoint);
  auto& positions = result.pixels.of_point;
  if (is_image(cloud)) {
    result.pixels.width = cloud.width;
    result.pixels.height = cloud.height;
    positions.resize(num_inside);
  }
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    const std::size_t begin = c * kChunk, first = chunks[c].first;
    kernels.copy_chosen(cloud.x.data() + begin, cloud.y.data() + begin, cloud.z.data() + begin,
                        masks.data() + begin / 8, std::min(kChunk, n - begin),
                        {kept.x.data() + first, kept.y.data() + first, kept.z.data() + first,
                         positions.empty() ? nullptr : positions.data() + first, chunks[c].num_inside,
                         static_cast<std::uint32_t>(begin)});
  });
  return result;
}

}  // namespace graspd
