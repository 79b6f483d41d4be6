// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/pinhole.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace graspd {
namespace {

constexpr double kMaxRmsPixels = 0.5;
constexpr std::size_t kMinPoints = 100;

/// A straight line by least squares, fed one point at a time.
class LineFit {
 public:
  void add(double x, double y) {
    ++n_;
    // Against the running means: no large sums that cancel.
    const double dx = x - mean_x_;
    mean_x_ += dx / n_;
    const double dy = y - mean_y_;
    mean_y_ += dy / n_;
    sxx_ += dx * (x - mean_x_);
    sxy_ += dx * (y - mean_y_);
    syy_ += dy * (y - mean_y_);
  }

  [[nodiscard]] double slope() const { return sxx_ > 0 ? sxy_ / sxx_ : 0; }
  [[nodiscard]] double offset() const { return mean_y_ - slope() * mean_x_; }
  [[nodiscard]] double rms() const { return std::sqrt(std::max(0.0, syy_ - slope() * sxy_) / n_); }
  [[nodiscard]] double spread() const { return std::sqrt(syy_ / n_); }

 private:
  double n_ = 0, mean_x_ = 0, mean_y_ = 0, sxx_ = 0, sxy_ = 0, syy_ = 0;
};

std::string pixels(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

std::optional<std::string> problem_of(const LineFit& fit, const char* axis) {
  if (fit.spread() < 5) return std::string("its points cover too little of the image along ") + axis;
  if (!(fit.slope() > 0))
    return std::string("not in an optical frame: ") + axis + " does not grow along the image";
  if (fit.rms() > kMaxRmsPixels) {
    return "not a pinhole image: along " + std::string(axis) + " pixels are " + pixels(fit.rms()) +
           " off the best fit, at most " + pixels(kMaxRmsPixels) + " expected";
  }
  return std::nullopt;
}

}  // namespace

std::variant<Pinhole, std::string> estimate_pinhole(const PointCloud& cloud) {
  if (cloud.height < 2 || cloud.width < 2) return "not organized: a depth image needs rows and columns";
  if (!cloud.viewpoint.isZero()) return "its viewpoint is not the origin, as it is in an optical frame";
  LineFit along_u;
  LineFit along_v;
  std::size_t used = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud.point(i).cast<double>();
    if (!p.allFinite() || p.isZero(0)) continue;
    if (p.z() <= 0) return "not in an optical frame: points lie behind the camera";
    const auto width = static_cast<std::size_t>(cloud.width);
    const std::size_t column = i % width, row = i / width;
    along_u.add(p.x() / p.z(), static_cast<double>(column));
    along_v.add(p.y() / p.z(), static_cast<double>(row));
    ++used;
  }
  if (used < kMinPoints)
    return "too few points: " + std::to_string(used) + ", expected " + std::to_string(kMinPoints);
  if (auto problem = problem_of(along_u, "x")) return *problem;
  if (auto problem = problem_of(along_v, "y")) return *problem;
  return Pinhole{cloud.width,     cloud.height,     along_u.slope(),
                 along_v.slope(), along_u.offset(), along_v.offset()};
}

std::vector<std::uint16_t> depth_units(std::span<const float> z_m, double depth_scale_m) {
  std::vector<std::uint16_t> units(z_m.size(), 0);
  for (std::size_t i = 0; i < z_m.size(); ++i) {
    const double value = std::round(static_cast<double>(z_m[i]) / depth_scale_m);
    if (value > 0 && value <= 65535) units[i] = static_cast<std::uint16_t>(value);
  }
  return units;
}

}  // namespace graspd
