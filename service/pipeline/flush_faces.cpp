// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/flush_faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace graspd {
namespace {

constexpr float kAcross = 0.35f;    // cosine: faces that are about at right angles
constexpr float kParallel = 0.97f;  // cosine: 14 degrees
constexpr float kStep = 0.005f;     // between the heights of faces [m]
constexpr float kOverlap = 0.2f;    // of the shorter of two that lie beside each other

FlushFace::Part extent(const PointCloud& cloud, const Segments& segments, std::int32_t s,
                       const Eigen::Vector3f& along) {
  FlushFace::Part part{s, std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
  for (const std::uint32_t i : segments.list[static_cast<std::size_t>(s)].points) {
    const float x = along.dot(cloud.point(i));
    part.low_m = std::min(part.low_m, x);
    part.high_m = std::max(part.high_m, x);
  }
  return part;
}

bool are_beside(const FlushFace::Part& a, const FlushFace::Part& b) {
  const float overlap = std::min(a.high_m, b.high_m) - std::max(a.low_m, b.low_m);
  return overlap < kOverlap * std::min(a.high_m - a.low_m, b.high_m - b.low_m);
}

bool has_step(const Segment& a, const Segment& b) {
  const Eigen::Vector3f normal = (a.normal + b.normal).normalized();
  return std::abs(normal.dot(a.centroid - b.centroid)) > kStep;
}

/// Whether the faces that meet this one there are all beside one another, and some at a step.
bool is_flush(const Segments& segments, const std::pmr::vector<FlushFace::Part>& parts) {
  bool steps = false;
  for (std::size_t k = 1; k < parts.size(); ++k) {
    if (!are_beside(parts[k - 1], parts[k])) return false;
    steps |= has_step(segments.list[static_cast<std::size_t>(parts[k - 1].segment)],
                      segments.list[static_cast<std::size_t>(parts[k].segment)]);
  }
  return steps;
}

/// The face with what meets it parallel to its neighbour first; parts are empty where it is not flush.
FlushFace as_flush(const PointCloud& cloud, const Segments& segments, std::int32_t face,
                   const std::pmr::vector<std::int32_t>& neighbors, std::int32_t first) {
  const Segment& f = segments.list[static_cast<std::size_t>(face)];
  const Eigen::Vector3f n = segments.list[static_cast<std::size_t>(first)].normal;
  FlushFace flush{face, f.normal.cross(n).normalized(), {}};
  for (const std::int32_t s : neighbors)
    if (segments.list[static_cast<std::size_t>(s)].normal.dot(n) > kParallel)
      flush.parts.push_back(extent(cloud, segments, s, flush.along));
  std::sort(flush.parts.begin(), flush.parts.end(), [](const FlushFace::Part& a, const FlushFace::Part& b) {
    return a.low_m + a.high_m < b.low_m + b.high_m;
  });
  if (flush.parts.size() < 2 || !is_flush(segments, flush.parts)) flush.parts.clear();
  return flush;
}

}  // namespace

const FlushFace::Part& FlushFace::part_at(const Eigen::Vector3f& p) const {
  const float x = along.dot(p);
  const auto distance = [x](const Part& part) { return std::max({part.low_m - x, x - part.high_m, 0.0f}); };
  return *std::min_element(parts.begin(), parts.end(),
                           [&](const Part& a, const Part& b) { return distance(a) < distance(b); });
}

std::pmr::vector<FlushFace> find_flush_faces(const PointCloud& cloud, const Segments& segments,
                                             std::span<const std::pair<std::int32_t, std::int32_t>> convex) {
  std::pmr::vector<std::pmr::vector<std::int32_t>> neighbors(segments.list.size());
  for (const auto& [a, b] : convex) {
    const float cosine = segments.list[static_cast<std::size_t>(a)].normal.dot(
        segments.list[static_cast<std::size_t>(b)].normal);
    if (std::abs(cosine) > kAcross) continue;
    neighbors[static_cast<std::size_t>(a)].push_back(b);
    neighbors[static_cast<std::size_t>(b)].push_back(a);
  }
  std::pmr::vector<FlushFace> found;
  for (std::size_t face = 0; face < neighbors.size(); ++face) {
    if (neighbors[face].size() < 2) continue;
    for (const std::int32_t first : neighbors[face]) {
      FlushFace flush = as_flush(cloud, segments, static_cast<std::int32_t>(face), neighbors[face], first);
      if (flush.parts.empty()) continue;
      found.push_back(std::move(flush));
      break;
    }
  }
  return found;
}

}  // namespace graspd
