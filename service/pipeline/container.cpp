// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/container.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "service/pipeline/cell_order.hpp"
#include "service/pipeline/members.hpp"

namespace graspd {
namespace {

constexpr float kMaxLean = 0.26f;      // sine: of an upright face's normal out of the horizontal
constexpr float kMaxScatter = 0.005f;  // root mean square of a flat face [m]
constexpr float kClear = 0.03f;        // what is farther than this from a face is beside it [m]
constexpr float kTrimmed = 0.02f;      // share of the points at either end that does not count for its length

struct Wall {
  Plane face;   // its normal horizontal
  float top_m;  // height above what the things in the container stand on
};

/// The value that so many others come before; reorders them.
float nth(std::pmr::vector<float>& values, std::size_t n) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(n);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Length of the middle part of some numbers; reorders them.
float trimmed_length(std::pmr::vector<float>& values) {
  if (values.empty()) return 0;
  const auto skip = static_cast<std::size_t>(kTrimmed * static_cast<float>(values.size()));
  return nth(values, values.size() - 1 - skip) - nth(values, skip);
}

/// Whether more than so many points lie well before the face, and as many well behind it.
bool stands_among(const PointRange& points, const Plane& face, std::size_t most) {
  constexpr std::size_t kBlock = 512;
  const float nx = face.normal.x(), ny = face.normal.y(), nz = face.normal.z(), offset = face.offset_m;
  std::size_t front = 0, behind = 0;
  for (std::size_t from = 0; from < points.size && std::min(front, behind) <= most; from += kBlock) {
    const std::size_t size = std::min(kBlock, points.size - from);
    const float *x = points.x + from, *y = points.y + from, *z = points.z + from;
    int before = 0, beyond = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const float d = nx * x[k] + (ny * y[k] + nz * z[k]) + offset;  // as Plane::height() has it
      before += d > kClear ? 1 : 0;
      beyond += d < -kClear ? 1 : 0;
    }
    front += static_cast<std::size_t>(before);
    behind += static_cast<std::size_t>(beyond);
  }
  return std::min(front, behind) > most;
}

/// Whether what has the face reaches back from it at the face's own height along most of its length, as books
/// that stand in a row do: walls of bins are thin.
bool is_thick(const PointRange& standing, const Plane& bottom, const Wall& wall, float thickness_m) {
  constexpr float kBin = 0.01f, kDepth = 0.05f, kBelowTop = 0.012f, kMostThick = 0.25f;
  constexpr int kBins = 1024;
  const Eigen::Vector3f along = bottom.normal.cross(wall.face.normal);
  const auto bin = [&](const Eigen::Vector3f& p) {
    return std::clamp(static_cast<int>(along.dot(p) / kBin) + kBins / 2, 0, kBins - 1);
  };
  std::array<float, kBins> face{}, behind{};  // highest of each, above the bottom
  for (std::size_t k = 0; k < standing.size; ++k) {
    const Eigen::Vector3f p(standing.x[k], standing.y[k], standing.z[k]);
    const float d = wall.face.height(p);
    if (d > thickness_m || d < -kDepth || (d < -thickness_m && d > -2 * thickness_m)) continue;
    float& top = (d < -thickness_m ? behind : face)[static_cast<std::size_t>(bin(p))];
    top = std::max(top, bottom.height(p));
  }
  int num_bins = 0, thick = 0;
  for (std::size_t k = 0; k < kBins; ++k) {
    num_bins += face[k] > 0 ? 1 : 0;
    thick += face[k] > 0 && std::abs(behind[k] - face[k]) < kBelowTop ? 1 : 0;
  }
  return static_cast<float>(thick) > kMostThick * static_cast<float>(num_bins);
}

/// The points near a face: how far along it they lie, and how high above the bottom.
struct SlabPoints {
  std::pmr::vector<float> lengths, heights;
};

SlabPoints points_near(const PointRange& points, const Plane& face, const Plane& bottom, float thickness_m) {
  constexpr std::size_t kBlock = 8;  // most blocks have no such point, which vectors tell at once
  const Eigen::Vector3f along = bottom.normal.cross(face.normal);
  const float nx = face.normal.x(), ny = face.normal.y(), nz = face.normal.z(), offset = face.offset_m;
  SlabPoints found;
  for (std::size_t from = 0; from < points.size; from += kBlock) {
    const float *x = points.x + from, *y = points.y + from, *z = points.z + from;
    float d[kBlock];
    int any = 0;
    for (std::size_t k = 0; k < kBlock; ++k) {
      d[k] = std::abs(nx * x[k] + (ny * y[k] + nz * z[k]) + offset);  // as Plane::height() has it
      any |= d[k] <= thickness_m ? 1 : 0;
    }
    if (any == 0) continue;
    for (std::size_t k = 0; k < std::min(kBlock, points.size - from); ++k) {
      if (d[k] > thickness_m) continue;
      const Eigen::Vector3f p(x[k], y[k], z[k]);
      found.lengths.push_back(along.dot(p));
      found.heights.push_back(bottom.height(p));
    }
  }
  return found;
}

/// Whether the face is long and high enough, and has nearly all points on one side.
bool is_wall(const PointRange& standing, const Plane& bottom, const ContainerConfig& config, Wall& wall) {
  const auto most = static_cast<std::size_t>(config.max_outside_share * static_cast<float>(standing.size));
  if (stands_among(standing, wall.face, most)) return false;
  SlabPoints near = points_near(standing, wall.face, bottom, config.thickness_m);
  if (trimmed_length(near.lengths) < config.min_length_m) return false;
  if (trimmed_length(near.heights) < 0.7f * config.min_height_m) return false;
  wall.top_m = nth(near.heights, near.heights.size() - 1 - near.heights.size() / 50);
  return wall.top_m >= config.min_height_m && !is_thick(standing, bottom, wall, config.thickness_m);
}

std::pmr::vector<Wall> find_walls(const Segments& segments, const PointRange& standing, const Plane& bottom,
                                  const ContainerConfig& config) {
  std::pmr::vector<Wall> walls;
  for (const Segment& segment : segments.list) {
    const float lean = segment.normal.dot(bottom.normal);
    if (std::abs(lean) > kMaxLean || segment.scatter_m > kMaxScatter) continue;
    const Eigen::Vector3f normal = (segment.normal - lean * bottom.normal).normalized();
    Wall wall{{normal, -normal.dot(segment.centroid)}, 0};
    if (is_wall(standing, bottom, config, wall)) walls.push_back(wall);
  }
  return walls;
}

/// Across each other, or parallel and well apart.
bool make_container(const Wall& a, const Wall& b, float min_apart_m) {
  const float cosine = a.face.normal.dot(b.face.normal);
  if (std::abs(cosine) < 0.35f) return true;
  const float apart = cosine > 0 ? a.face.offset_m - b.face.offset_m : a.face.offset_m + b.face.offset_m;
  return std::abs(cosine) > 0.94f && std::abs(apart) > min_apart_m;
}

}  // namespace

std::pmr::vector<std::uint8_t> find_container(const PointCloud& cloud, const Segments& segments,
                                              const Support& support, const ContainerConfig& config) {
  if (!config.enabled) return {};
  const Plane& bottom = support.lowest_plane();
  const RawVector<std::uint32_t> standing = unmarked(support.is_support, cloud.size());
  const PaddedPoints points(cloud, standing);
  std::pmr::vector<Wall> walls = find_walls(segments, points.all(), bottom, config);
  const std::pmr::vector<Wall> all = walls;
  std::erase_if(walls, [&](const Wall& wall) {
    return std::none_of(all.begin(), all.end(), [&](const Wall& other) {
      return make_container(wall, other, 0.5f * config.min_length_m);
    });
  });
  if (walls.empty()) return {};
  std::pmr::vector<std::uint8_t> belongs(cloud.size());
  for (const std::uint32_t i : standing) {
    const Eigen::Vector3f p = cloud.point(i);
    const float height = bottom.height(p);
    belongs[i] = std::any_of(walls.begin(), walls.end(), [&](const Wall& wall) {
      return std::abs(wall.face.height(p)) <= config.thickness_m && height <= wall.top_m + config.thickness_m;
    });
  }
  return belongs;
}

}  // namespace graspd
