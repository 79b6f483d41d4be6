// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/pinhole_fit.hpp"

#include <array>
#include <cmath>
#include <random>

namespace graspd {
namespace {

constexpr std::size_t kSampleSize = 1024;

/// Slopes x / z or y / z of points, and the columns or rows of their pixels.
struct AxisSample {
  std::array<double, kSampleSize> slope, pixel;
};

/// pixel = focal * slope + center.
struct Line {
  double focal, center;
};

std::optional<Line> fit_line(const AxisSample& sample) {
  double slope = 0, pixel = 0;
  for (std::size_t i = 0; i < kSampleSize; ++i) {
    slope += sample.slope[i] / kSampleSize;
    pixel += sample.pixel[i] / kSampleSize;
  }
  double squares = 0, products = 0;
  for (std::size_t i = 0; i < kSampleSize; ++i) {
    squares += (sample.slope[i] - slope) * (sample.slope[i] - slope);
    products += (sample.slope[i] - slope) * (sample.pixel[i] - pixel);
  }
  const Line line{products / squares, pixel - products / squares * slope};
  // Also false for NaN: points of one column or row alone.
  const bool is_camera = line.focal > 0 && std::isfinite(line.focal) && std::isfinite(line.center);
  if (!is_camera) return std::nullopt;
  for (std::size_t i = 0; i < kSampleSize; ++i)
    if (!(std::abs(line.focal * sample.slope[i] + line.center - sample.pixel[i]) < 0.5)) return std::nullopt;
  return line;
}

}  // namespace

std::optional<PinholeModel> fit_pinhole(const PointCloud& cloud, const ImagePixels& pixels) {
  const std::size_t n = cloud.size();
  if (pixels.width < 2 || pixels.height < 2 || n == 0 || pixels.of_point.size() != n) return std::nullopt;
  const auto width = static_cast<std::uint32_t>(pixels.width);
  std::minstd_rand random(1);
  AxisSample columns, rows;
  for (std::size_t k = 0; k < kSampleSize; ++k) {
    const std::size_t i = random() % n;
    const Eigen::Vector3d p = (cloud.point(i) - cloud.viewpoint).cast<double>();
    if (p.z() <= 0) return std::nullopt;
    columns.slope[k] = p.x() / p.z();
    rows.slope[k] = p.y() / p.z();
    const std::uint32_t column = pixels.of_point[i] % width, row = pixels.of_point[i] / width;
    columns.pixel[k] = column;
    rows.pixel[k] = row;
  }
  const std::optional<Line> u = fit_line(columns), v = fit_line(rows);
  if (!u || !v) return std::nullopt;
  return PinholeModel{static_cast<float>(u->focal), static_cast<float>(v->focal),
                      static_cast<float>(u->center), static_cast<float>(v->center)};
}

}  // namespace graspd
