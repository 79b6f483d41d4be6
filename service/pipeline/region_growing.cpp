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

constexpr float kNever = 2;           // least cosine of points that take no part
constexpr std::size_t kChunk = 4096;  // points that are linked among themselves first

float cos_deg(float angle_deg) {
  return std::cos(angle_deg * std::numbers::pi_v<float> / 180);
}

/// Links points into sets: those of a chunk by themselves, which may run beside others, then across chunks.
class Linker {
 public:
  Linker(const Normals& normals, const Neighborhoods& neighborhoods, const RawVector<float>& least_cosine)
      : neighborhoods_(neighborhoods),
        kernels_(point_kernels()),
        sets_(normals.size()),
        test_{normals.arrays(), least_cosine.data(), sets_.parents().data()} {}

  [[nodiscard]] UnionFind linked() && {
    const std::span<const std::uint32_t> points = neighborhoods_.points();
    const std::size_t num_chunks = (points.size() + kChunk - 1) / kChunk;
    std::pmr::vector<std::pmr::vector<std::uint32_t>> crossing(num_chunks);
    const auto num = static_cast<std::uint32_t>(neighborhoods_.size());
    const auto end_of = [&](std::size_t c) { return c + 1 < num_chunks ? points[(c + 1) * kChunk] : num; };
    tbb::parallel_for(std::size_t{0}, num_chunks, [&](std::size_t c) {
      const std::uint32_t end = end_of(c);
      RawVector<std::uint32_t> found;
      for (const std::uint32_t s : points.subspan(c * kChunk, std::min(kChunk, points.size() - c * kChunk)))
        if (test_.least_cosine[s] < kNever && link(s, s + 1, end, found)) crossing[c].push_back(s);
    });
    RawVector<std::uint32_t> found;
    for (std::size_t c = 0; c < num_chunks; ++c)
      for (const std::uint32_t s : crossing[c]) link(s, end_of(c), num, found);
    return std::move(sets_);
  }

 private:
  /// Returns whether there are neighbours beyond the last. found: working memory.
  bool link(std::uint32_t s, std::uint32_t first, std::uint32_t last, RawVector<std::uint32_t>& found) {
    const std::span<const std::uint32_t> near = neighborhoods_.of(s);
    if (found.size() < near.size() + kPointPadding) found.resize(2 * near.size() + kPointPadding);
    const FoundLinks links =
        kernels_.find_links(test_, {s, sets_.find(s), first, last}, near.data(), near.size(), found.data());
    for (std::size_t k = 0; k < links.num; ++k) sets_.unite(s, found[k]);
    return links.any_beyond;
  }

  const Neighborhoods& neighborhoods_;
  const PointKernels& kernels_;
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
Labels label_components(UnionFind& sets, std::span<const std::uint32_t> points,
                        const std::pmr::vector<std::uint8_t>& is_edge, const RawVector<float>& least_cosine) {
  sets.flatten(points);
  const std::span<const std::uint32_t> root = sets.parents();
  std::pmr::vector<std::uint8_t> has_surface(root.size());  // by representative
  for (const std::uint32_t s : points)
    if (is_edge[s] == 0 && least_cosine[s] < kNever) has_surface[root[s]] = 1;
  Labels labels;
  labels.of_point.assign(root.size(), -1);
  for (const std::uint32_t s : points) {
    // The representative comes first.
    const bool is_new = root[s] == s && has_surface[s];
    labels.of_point[s] = is_new ? labels.num_labels++ : root[s] == s ? -1 : labels.of_point[root[s]];
  }
  return labels;
}

/// Gives points without a label that of their most similar neighbour.
void label_rest(const Normals& normals, const Neighborhoods& neighborhoods,
                const RawVector<float>& least_cosine, Labels& labels) {
  std::pmr::vector<std::uint32_t> rest;
  for (const std::uint32_t s : neighborhoods.points())
    if (labels.of_point[s] < 0 && least_cosine[s] < kNever) rest.push_back(s);
  std::pmr::vector<std::int32_t> found(rest.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rest.size(), 512), [&](const auto& range) {
    for (std::size_t k = range.begin(); k != range.end(); ++k)
      found[k] = most_similar_label(normals, neighborhoods.of(rest[k]), rest[k], labels.of_point);
  });
  for (std::size_t k = 0; k < rest.size(); ++k) labels.of_point[rest[k]] = found[k];
}

}  // namespace

Labels grow_regions(const Normals& normals, const Neighborhoods& neighborhoods,
                    const std::pmr::vector<std::uint8_t>& is_edge,
                    const std::pmr::vector<std::uint8_t>& excluded, const SmoothnessConfig& config) {
  const std::size_t n = normals.size();
  const float cos_low = cos_deg(config.theta_low_deg), cos_high = cos_deg(config.theta_high_deg);
  RawVector<float> least_cosine(n);
  std::fill(least_cosine.begin(), least_cosine.end(), kNever);
  for (const std::uint32_t s : neighborhoods.points())
    if (excluded.empty() || excluded[s] == 0) least_cosine[s] = is_edge[s] != 0 ? cos_low : cos_high;
  UnionFind sets = Linker(normals, neighborhoods, least_cosine).linked();
  Labels result = label_components(sets, neighborhoods.points(), is_edge, least_cosine);
  label_rest(normals, neighborhoods, least_cosine, result);
  return result;
}

}  // namespace graspd
