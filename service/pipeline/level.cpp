// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/level.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "service/pipeline/nth_value.hpp"
#include "service/pipeline/raw_vector.hpp"

namespace graspd {
namespace {

constexpr float kSpacings = 1.5f;  // of the points in a cell: with less, some on the surface would be empty

/// Where a grid's first cell begins along an axis, and how many cells it takes for the values, with a border;
/// of values far away from most of the others it takes none.
std::pair<float, std::size_t> bounds(const RawVector<float>& values, float cell_m) {
  constexpr float kMostHalf = 500;  // of the grid, whatever the cloud [cells]
  constexpr float kBorder = LevelExtent::kMostCells + 1;
  RawVector<float> by_size(values);
  const float middle = nth_value(by_size, by_size.size() / 2);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const float below = std::min(kMostHalf, (middle - *low) / cell_m + kBorder),
              above = std::min(kMostHalf, (*high - middle) / cell_m + kBorder);
  return {middle - below * cell_m, static_cast<std::size_t>(below + above) + 1};
}

}  // namespace

LevelExtent::LevelExtent(const PointCloud& cloud, std::span<const std::uint32_t> points, const Plane& plane,
                         float spacing_m)
    : u_(plane.normal.unitOrthogonal()), v_(plane.normal.cross(u_)), cell_m_(kSpacings * spacing_m) {
  if (points.empty()) return;
  RawVector<float> u(points.size()), v(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    u[k] = u_.dot(cloud.point(points[k]));
    v[k] = v_.dot(cloud.point(points[k]));
  }
  const auto [first_column, columns] = bounds(u, cell_m_);
  const auto [first_row, rows] = bounds(v, cell_m_);
  low_ = {first_column, first_row};
  columns_ = columns;
  rows_ = rows;
  distance_.resize(columns_ * rows_);
  for (std::size_t k = 0; k < points.size(); ++k)
    if (const auto cell = cell_of({u[k], v[k]})) distance_[*cell] = 1;
  keep_largest_part();
  for (std::size_t k = 0; k < points.size(); ++k)
    if (const auto cell = cell_of({u[k], v[k]}); cell && distance_[*cell] == 1)
      area_m2_ += spacing_m * spacing_m;
  measure_width();
  fill_gaps();
  mark_surroundings();
}

std::optional<std::size_t> LevelExtent::cell_of(const Eigen::Vector2f& place) const {
  const Eigen::Vector2f at = (place - low_) / cell_m_;
  if (!(at.minCoeff() >= 1 && at.x() < static_cast<float>(columns_) - 1 &&
        at.y() < static_cast<float>(rows_) - 1))
    return std::nullopt;
  return static_cast<std::size_t>(at.y()) * columns_ + static_cast<std::size_t>(at.x());
}

void LevelExtent::keep_largest_part() {
  std::pmr::vector<std::size_t> largest, part;
  for (std::size_t start = 0; start < distance_.size(); ++start) {
    if (distance_[start] != 1) continue;
    part.assign(1, start);
    distance_[start] = 0;
    for (std::size_t k = 0; k < part.size(); ++k)
      for (const std::size_t row : {part[k] - columns_, part[k], part[k] + columns_})
        for (const std::size_t next : {row - 1, row, row + 1})
          if (std::exchange(distance_[next], std::uint8_t{0}) == 1) part.push_back(next);
    if (part.size() > largest.size()) largest.swap(part);
  }
  for (const std::size_t cell : largest) distance_[cell] = 1;
}

void LevelExtent::measure_width() {
  Eigen::Matrix2f squares = Eigen::Matrix2f::Zero();
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  std::pmr::vector<Eigen::Vector2f> places;
  for (std::size_t cell = 0; cell < distance_.size(); ++cell) {
    if (distance_[cell] == 0) continue;
    const std::size_t row = cell / columns_, column = cell % columns_;
    places.emplace_back(static_cast<float>(column), static_cast<float>(row));
    sum += places.back();
  }
  const Eigen::Vector2f mean = sum / static_cast<float>(std::max<std::size_t>(1, places.size()));
  for (const Eigen::Vector2f& place : places) squares += (place - mean) * (place - mean).transpose();
  const Eigen::Vector2f across =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2f>(squares).eigenvectors().col(0);
  float low = 0, high = 0;
  for (const Eigen::Vector2f& place : places) {
    low = std::min(low, across.dot(place - mean));
    high = std::max(high, across.dot(place - mean));
  }
  width_m_ = (high - low + 1) * cell_m_;
}

/// Cells with others on all four sides.
void LevelExtent::fill_gaps() {
  struct Range {
    std::size_t first = std::numeric_limits<std::size_t>::max(), last = 0;
    void extend(std::size_t k) {
      first = std::min(first, k);
      last = std::max(last, k);
    }
    [[nodiscard]] bool has(std::size_t k) const { return k >= first && k <= last; }
  };
  std::pmr::vector<Range> of_row(rows_), of_column(columns_);
  for (std::size_t cell = 0; cell < distance_.size(); ++cell) {
    if (distance_[cell] == 0) continue;
    of_row[cell / columns_].extend(cell % columns_);
    of_column[cell % columns_].extend(cell / columns_);
  }
  for (std::size_t cell = 0; cell < distance_.size(); ++cell)
    if (of_row[cell / columns_].has(cell % columns_) && of_column[cell % columns_].has(cell / columns_))
      distance_[cell] = 1;
}

void LevelExtent::mark_surroundings() {
  for (std::uint8_t ring = 1; ring <= kMostCells; ++ring)
    for (std::size_t cell = columns_; cell + columns_ < distance_.size(); ++cell) {
      if (distance_[cell] != 0) continue;
      for (const std::size_t next : {cell - 1, cell + 1, cell - columns_, cell + columns_})
        if (distance_[next] == ring) distance_[cell] = static_cast<std::uint8_t>(ring + 1);
    }
}

bool LevelExtent::covers(const Eigen::Vector3f& p, int cells) const {
  const auto cell = cell_of({u_.dot(p), v_.dot(p)});
  return cell && distance_[*cell] != 0 && distance_[*cell] <= cells + 1;
}

bool Level::blocks(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const {
  const float h0 = plane.height(from), h1 = plane.height(to);
  if ((h0 < 0) != (h1 < 0)) return extent.covers(from + h0 / (h0 - h1) * (to - from), 1);
  return is_solid && h0 < 0 && (extent.covers(from, 0) || extent.covers(to, 0));
}

std::uint32_t level_under(std::span<const Level> levels, const Eigen::Vector3f& middle,
                          const Eigen::Vector3f& lowest) {
  constexpr float kBelow = 0.02f;  // that points may be, which noise moves [m]
  for (std::size_t k = levels.size(); k-- > 1;)
    if (levels[k].plane.height(lowest) > -kBelow && levels[k].extent.covers(middle, LevelExtent::kMostCells))
      return static_cast<std::uint32_t>(k);
  return 0;
}

}  // namespace graspd
