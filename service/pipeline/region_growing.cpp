// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/region_growing.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "service/pipeline/point_kernels.hpp"
#include "service/pipeline/union_find.hpp"

namespace graspd {
namespace {

constexpr float kNever = 2;             // least cosine of points that take no part
constexpr std::uint32_t kChunk = 8192;  // points that are linked among themselves first

float cos_deg(float angle_deg) {
  return std::cos(angle_deg * std::numbers::pi_v<float> / 180);
}

/// Links points into sets: those of a chunk by themselves, which may run beside others, then across chunks.
class Linker {
 public:
  Linker(const Normals& normals, const Neighborhoods& neighborhoods, const RawVector<float>& least_cosine)
      : neighborhoods_(neighborhoods),
        num_(static_cast<std::uint32_t>(normals.size())),
        sets_(normals.size()),
        test_{normals.arrays(), least_cosine.data(), sets_.parents().data()} {}

  [[nodiscard]] UnionFind linked() && {
    const std::size_t num_chunks = (num_ + kChunk - 1) / kChunk;
    std::pmr::vector<std::pmr::vector<std::uint32_t>> crossing(num_chunks);
    tbb::parallel_for(std::size_t{0}, num_chunks, [&](std::size_t c) {
      const auto begin = static_cast<std::uint32_t>(c) * kChunk, end = std::min(begin + kChunk, num_);
      std::pmr::vector<std::uint32_t> found;
      for (std::uint32_t s = begin; s < end; ++s) {
        if (!takes_part(s)) continue;
        link(s, s + 1, end, found);
        if (reaches(s, end)) crossing[c].push_back(s);
      }
    });
    std::pmr::vector<std::uint32_t> found;
    for (std::size_t c = 0; c < num_chunks; ++c)
      for (const std::uint32_t s : crossing[c])
        link(s, (static_cast<std::uint32_t>(c) + 1) * kChunk, num_, found);
    return std::move(sets_);
  }

 private:
  [[nodiscard]] bool takes_part(std::uint32_t s) const {
    return test_.least_cosine[s] < kNever && !neighborhoods_.of(s).empty();
  }
  [[nodiscard]] bool reaches(std::uint32_t s, std::uint32_t end) const {
    if (end == num_) return false;
    const std::span<const std::uint32_t> near = neighborhoods_.of(s);
    int num = 0;  // all of them are compared, several at a time
    for (const std::uint32_t p : near)
      num += static_cast<std::int32_t>(p) >= static_cast<std::int32_t>(end) ? 1 : 0;
    return num > 0;
  }
  /// found: working memory.
  void link(std::uint32_t s, std::uint32_t first, std::uint32_t last,
            std::pmr::vector<std::uint32_t>& found) {
    const std::span<const std::uint32_t> near = neighborhoods_.of(s);
    if (found.size() < near.size() + kPointPadding) found.resize(2 * near.size() + kPointPadding);
    const std::size_t num = point_kernels().find_links(test_, {s, sets_.find(s), first, last}, near.data(),
                                                       near.size(), found.data());
    for (std::size_t k = 0; k < num; ++k) sets_.unite(s, found[k]);
  }

  const Neighborhoods& neighborhoods_;
  std::uint32_t num_;
  UnionFind sets_;
  LinkTest test_;
};

/// Label of the neighbour with the most similar normal that has one, or -1.
std::int32_t most_similar_label(const Normals& normals, std::span<const std::uint32_t> neighborhood,
                                std::size_t s, const std::pmr::vector<std::int32_t>& labels) {
  std::int32_t label = -1;
  float best = -2;
  for (const std::uint32_t p : neighborhood) {
    if (labels[p] < 0) continue;
    const float cosine = normals.at(s).dot(normals.at(p));
    if (cosine <= best) continue;
    best = cosine;
    label = labels[p];
  }
  return label;
}

/// Labels of the components that have a point that takes part and is no edge point.
Labels label_components(UnionFind& sets, const std::pmr::vector<std::uint8_t>& is_edge,
                        const RawVector<float>& least_cosine) {
  sets.flatten();
  const std::span<const std::uint32_t> root = sets.parents();
  std::pmr::vector<std::uint8_t> has_surface(root.size());  // by representative
  for (std::size_t s = 0; s < root.size(); ++s)
    if (is_edge[s] == 0 && least_cosine[s] < kNever) has_surface[root[s]] = 1;
  Labels labels;
  labels.of_point.resize(root.size());
  for (std::size_t s = 0; s < root.size(); ++s) {
    // The representative comes first.
    const bool is_new = root[s] == s && has_surface[s];
    labels.of_point[s] = is_new ? labels.num_labels++ : root[s] == s ? -1 : labels.of_point[root[s]];
  }
  return labels;
}

}  // namespace

Labels grow_regions(const Normals& normals, const Neighborhoods& neighborhoods,
                    const std::pmr::vector<std::uint8_t>& is_edge,
                    const std::pmr::vector<std::uint8_t>& excluded, const SmoothnessConfig& config) {
  const std::size_t n = normals.size();
  const float cos_low = cos_deg(config.theta_low_deg), cos_high = cos_deg(config.theta_high_deg);
  RawVector<float> least_cosine(n);
  for (std::size_t s = 0; s < n; ++s) least_cosine[s] = is_edge[s] ? cos_low : cos_high;
  for (std::size_t s = 0; s < excluded.size(); ++s) least_cosine[s] = excluded[s] ? kNever : least_cosine[s];
  UnionFind sets = Linker(normals, neighborhoods, least_cosine).linked();
  Labels result = label_components(sets, is_edge, least_cosine);
  const std::pmr::vector<std::int32_t> grown = result.of_point;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 2048), [&](const auto& range) {
    for (std::size_t s = range.begin(); s != range.end(); ++s)
      if (grown[s] < 0 && least_cosine[s] < kNever)
        result.of_point[s] = most_similar_label(normals, neighborhoods.of(s), s, grown);
  });
  return result;
}

}  // namespace graspd
