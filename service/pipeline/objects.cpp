// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/objects.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "service/pipeline/flush_faces.hpp"
#include "service/pipeline/members.hpp"
#include "service/pipeline/point_kernels.hpp"
#include "service/pipeline/union_find.hpp"

namespace graspd {
namespace {

struct Border {
  int pairs = 0;
  int convex = 0;
  Eigen::Vector3f across = Eigen::Vector3f::Zero();  // sum of the ways from the second group to the first
};
using Borders = std::pmr::map<std::pair<std::int32_t, std::int32_t>, Border>;

using Groups = std::pmr::vector<std::int32_t>;

constexpr std::size_t kChunk = 1024;  // points that are looked at together

/// The points at which groups may meet: those with neighbours of another group or of none, and all that have
/// none.
RawVector<std::uint32_t> points_at_borders(const Neighborhoods& neighborhoods, const Groups& group_of_point) {
  const PointKernels& kernels = point_kernels();
  const std::span<const std::uint32_t> points = neighborhoods.points();
  RawVector<std::uint8_t> is_inside(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kChunk), [&](const auto& range) {
    for (std::size_t k = range.begin(); k != range.end(); ++k) {
      const std::span<const std::uint32_t> near = neighborhoods.of(points[k]);
      const std::int32_t own = group_of_point[points[k]];
      is_inside[k] =
          own >= 0 && !kernels.any_other(group_of_point.data(), own, near.data(), near.size()) ? 1 : 0;
    }
  });
  RawVector<std::uint32_t> found(points.size() + kPointPadding);
  found.resize(kernels.list_unmarked(is_inside.data(), is_inside.size(), found.data()));
  for (std::uint32_t& k : found) k = points[k];
  return found;
}

/// The borders that the points have with groups of larger numbers.
Borders borders_of(const PointCloud& cloud, const Normals& normals, const Neighborhoods& neighborhoods,
                   std::span<const std::uint32_t> points, const Groups& group_of_point) {
  Borders borders;
  RawVector<std::uint32_t> others;
  for (const std::uint32_t i : points) {
    const std::int32_t a = group_of_point[i];
    if (a < 0) continue;
    const std::span<const std::uint32_t> near = neighborhoods.of(i);
    if (others.size() < near.size() + kPointPadding) others.resize(2 * near.size() + kPointPadding);
    const std::size_t num =
        point_kernels().list_above(group_of_point.data(), a, near.data(), near.size(), others.data());
    std::int32_t last = a;
    Border* border = nullptr;  // with the last
    for (const std::uint32_t j : std::span(others.data(), num)) {
      const std::int32_t b = group_of_point[j];
      if (b != last) border = &borders[{a, b}];
      last = b;
      ++border->pairs;
      const Eigen::Vector3f across = cloud.point(i) - cloud.point(j);
      border->across += across;
      border->convex += (normals.at(i) - normals.at(j)).dot(across) > 0 ? 1 : 0;
    }
  }
  return borders;
}

/// points: all at which groups meet.
Borders find_borders(const PointCloud& cloud, const Normals& normals, const Neighborhoods& neighborhoods,
                     std::span<const std::uint32_t> points, const Groups& group_of_point) {
  std::pmr::vector<Borders> parts((points.size() + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t c) {
    const std::size_t begin = c * kChunk, size = std::min(kChunk, points.size() - begin);
    parts[c] = borders_of(cloud, normals, neighborhoods, points.subspan(begin, size), group_of_point);
  });
  Borders borders;
  for (const Borders& part : parts)
    for (const auto& [pair, more] : part) {
      Border& border = borders[pair];
      border.pairs += more.pairs;
      border.convex += more.convex;
      border.across += more.across;
    }
  return borders;
}

/// Parallel faces with a step between them: of two things that touch. A thing's own faces at the foot and the
/// top of a step are parted by the face between them.
bool is_step(const Segment& a, const Segment& b, const Border& border) {
  constexpr float kParallel = 0.94f;  // cosine: 20 degrees
  constexpr float kStep = 0.002f;     // mean height of neighbours over neighbours [m]
  if (a.normal.dot(b.normal) < kParallel) return false;
  const Eigen::Vector3f normal = (a.normal + b.normal).normalized();
  return std::abs(normal.dot(border.across)) > kStep * static_cast<float>(border.pairs);
}

bool joins(const Border& border, int min_pairs, float min_convex_share) {
  return border.pairs >= min_pairs &&
         static_cast<float>(border.convex) >= min_convex_share * static_cast<float>(border.pairs);
}

/// Leaves a flush face one border, with the thing that most of it is of.
std::pmr::vector<FlushFace> part_flush_faces(const PointCloud& cloud, const Segments& segments,
                                             const ObjectsConfig& config, Borders& borders) {
  std::pmr::vector<std::pair<std::int32_t, std::int32_t>> convex;
  for (const auto& [pair, border] : borders)
    if (joins(border, config.min_border_pairs, config.min_convex_share)) convex.push_back(pair);
  std::pmr::vector<FlushFace> faces = find_flush_faces(cloud, segments, convex);
  for (const FlushFace& face : faces) {
    std::pmr::map<std::int32_t, int> points;
    for (const std::uint32_t i : segments.list[static_cast<std::size_t>(face.segment)].points)
      ++points[face.part_at(cloud.point(i)).segment];
    const std::int32_t most =
        std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) {
          return a.second < b.second;
        })->first;
    std::erase_if(borders, [&](const auto& entry) {
      const auto [a, b] = entry.first;
      return (a == face.segment && b != most) || (b == face.segment && a != most);
    });
  }
  return faces;
}

/// Number of each group's set, in the order of their first groups.
std::pmr::vector<std::int32_t> merge(std::size_t num_groups, const Borders& borders, int min_pairs,
                                     float min_convex_share, int& num_sets) {
  UnionFind sets(num_groups);
  for (const auto& [pair, border] : borders) {
    if (!joins(border, min_pairs, min_convex_share)) continue;
    sets.unite(static_cast<std::uint32_t>(pair.first), static_cast<std::uint32_t>(pair.second));
  }
  std::pmr::vector<std::int32_t> set_of_group(num_groups, -1);
  num_sets = 0;
  for (std::uint32_t g = 0; g < num_groups; ++g) {
    const std::uint32_t root = sets.find(g);
    set_of_group[g] = root == g ? num_sets++ : set_of_group[root];
  }
  return set_of_group;
}

/// The object that most of the neighbours have, of several the one with the smallest number; -1: none has
/// one. votes: working memory.
std::int32_t most_frequent(std::span<const std::uint32_t> near, const Groups& of_point,
                           std::pmr::vector<std::pair<std::int32_t, int>>& votes) {
  votes.clear();
  for (const std::uint32_t j : near) {
    const std::int32_t object = of_point[j];
    if (object < 0) continue;
    const auto vote =
        std::find_if(votes.begin(), votes.end(), [object](const auto& v) { return v.first == object; });
    if (vote == votes.end())
      votes.emplace_back(object, 1);
    else
      ++vote->second;
  }
  std::pair<std::int32_t, int> best{-1, 0};
  for (const auto& [object, count] : votes)
    if (count > best.second || (count == best.second && object < best.first)) best = {object, count};
  return best.first;
}

/// Gives each of the points, which have none, the object of most of its neighbours.
void fill(const Neighborhoods& neighborhoods, std::span<const std::uint32_t> points, Groups& of_point) {
  const PointKernels& kernels = point_kernels();
  Groups found(points.size(), -1);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kChunk), [&](const auto& range) {
    std::pmr::vector<std::pair<std::int32_t, int>> votes;
    for (std::size_t k = range.begin(); k != range.end(); ++k) {
      const std::span<const std::uint32_t> near = neighborhoods.of(points[k]);
      if (kernels.any_other(of_point.data(), -1, near.data(), near.size()))
        found[k] = most_frequent(near, of_point, votes);
    }
  });
  for (std::size_t k = 0; k < points.size(); ++k) of_point[points[k]] = found[k];
}

std::pmr::vector<Eigen::Vector3f> centers(const PointCloud& cloud, const Objects& objects) {
  std::pmr::vector<Eigen::Vector3d> sum(static_cast<std::size_t>(objects.num_objects),
                                        Eigen::Vector3d::Zero());
  std::pmr::vector<double> count(sum.size());
  for (const std::uint32_t i : members(objects.of_point)) {
    const auto object = static_cast<std::size_t>(objects.of_point[i]);
    sum[object] += cloud.point(i).cast<double>();
    ++count[object];
  }
  std::pmr::vector<Eigen::Vector3f> result;
  for (std::size_t k = 0; k < sum.size(); ++k) result.emplace_back((sum[k] / count[k]).cast<float>());
  return result;
}

}  // namespace

ObjectPoints points_by_object(const Objects& objects) {
  ObjectPoints result;
  result.starts.assign(static_cast<std::size_t>(objects.num_objects) + 1, 0);
  const RawVector<std::uint32_t> found = members(objects.of_point);
  for (const std::uint32_t i : found) ++result.starts[static_cast<std::size_t>(objects.of_point[i]) + 1];
  std::partial_sum(result.starts.begin(), result.starts.end(), result.starts.begin());
  result.points.resize(result.starts.back());
  std::pmr::vector<std::uint32_t> next = result.starts;
  for (const std::uint32_t i : found)
    result.points[next[static_cast<std::size_t>(objects.of_point[i])]++] = i;
  return result;
}

std::pmr::vector<std::uint8_t> objects_with_segments(const Objects& objects,
                                                     const std::pmr::vector<std::uint8_t>& wanted) {
  std::pmr::vector<std::uint8_t> has(static_cast<std::size_t>(objects.num_objects));
  for (std::size_t s = 0; s < wanted.size(); ++s)
    if (wanted[s] != 0) has[static_cast<std::size_t>(objects.of_segment[s])] = 1;
  return has;
}

Objects group_segments(const PointCloud& cloud, const Normals& normals, const Neighborhoods& neighborhoods,
                       const Segments& segments, const std::pmr::vector<std::uint8_t>& is_support,
                       const ObjectsConfig& config) {
  Objects objects;
  objects.at_borders = points_at_borders(neighborhoods, segments.of_point);
  Borders borders = find_borders(cloud, normals, neighborhoods, objects.at_borders, segments.of_point);
  std::erase_if(borders, [&](const auto& entry) {
    const auto a = entry.first.first, b = entry.first.second;
    return is_step(segments.list[static_cast<std::size_t>(a)], segments.list[static_cast<std::size_t>(b)],
                   entry.second);
  });
  const std::pmr::vector<FlushFace> flush = part_flush_faces(cloud, segments, config, borders);
  objects.of_segment = merge(segments.list.size(), borders, config.min_border_pairs, config.min_convex_share,
                             objects.num_objects);
  objects.of_point.assign(cloud.size(), -1);
  for (const std::uint32_t i : members(segments.of_point))
    objects.of_point[i] = objects.of_segment[static_cast<std::size_t>(segments.of_point[i])];
  for (const FlushFace& face : flush)
    for (const std::uint32_t i : segments.list[static_cast<std::size_t>(face.segment)].points)
      objects.of_point[i] =
          objects.of_segment[static_cast<std::size_t>(face.part_at(cloud.point(i)).segment)];
  for (int round = 0; round < 2; ++round) {
    std::pmr::vector<std::uint32_t> open;
    for (const std::uint32_t i : objects.at_borders)
      if (objects.of_point[i] < 0 && (is_support.empty() || is_support[i] == 0)) open.push_back(i);
    fill(neighborhoods, open, objects.of_point);
  }
  objects.center = centers(cloud, objects);
  return objects;
}

Objects merge_objects(const PointCloud& cloud, const Normals& normals, const Neighborhoods& neighborhoods,
                      const Objects& objects, const ObjectsConfig& config) {
  const Borders borders = find_borders(cloud, normals, neighborhoods, objects.at_borders, objects.of_point);
  Objects wholes;
  const std::pmr::vector<std::int32_t> whole =
      merge(static_cast<std::size_t>(objects.num_objects), borders, config.min_border_pairs,
            config.min_whole_convex_share, wholes.num_objects);
  const auto mapped = [&whole](const Groups& of) {
    Groups result(of.size(), -1);
    for (const std::uint32_t i : members(of)) result[i] = whole[static_cast<std::size_t>(of[i])];
    return result;
  };
  wholes.of_segment = mapped(objects.of_segment);
  wholes.of_point = mapped(objects.of_point);
  wholes.center = centers(cloud, wholes);
  return wholes;
}

}  // namespace graspd
