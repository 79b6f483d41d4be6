// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/rim_wall.hpp"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory_resource>
#include <vector>

#include "service/pipeline/normal_lines.hpp"
#include "service/pipeline/point_kernels.hpp"
#include "service/pipeline/raw_vector.hpp"

namespace graspd {
namespace {

constexpr float kEdge = 0.003f;       // below the rim, where points are of the edge itself [m]
constexpr float kDeep = 0.050f;       // of the points that count, below the rim [m]
constexpr float kMaxAside = 0.030f;   // of them along it [m]
constexpr float kMaxAcross = 0.020f;  // and across it [m]
constexpr float kMinFacing = 0.7f;    // cosine between a point's normal and the rim's
constexpr float kMinRoundFacing = 0.5f;
constexpr float kMinSector = 0.2f;  // cosine of the angle about the axis
constexpr float kBetween = 0.2f;    // of kDeep: about where jaws meet the wall
constexpr float kScale = 0.003f;    // of the weights [m]
constexpr float kRidge = 1e-4f;     // on the scaled normal equations
constexpr int kRounds = 3;          // of weighing points anew
constexpr std::size_t kMinPoints = 8;

template <int n>
struct Fit {
  Eigen::Matrix<float, n, 1> c;
  Eigen::Matrix<float, n, n> covariance;  ///< of c, as if the noise of points were their own
  float variance;                         ///< of what is left [m^2]
};

using Row = Eigen::Matrix<float, 6, 1>;

/// A point of the wall: how far out it is, and what a quadratic surface there is a sum of.
struct Sample {
  Row row;
  float out;
};

/// Least squares, reweighted by Cauchy weights.
Fit<6> fit_surface(const std::pmr::vector<Sample>& samples) {
  Row c = Row::Zero();
  Eigen::Matrix<float, 6, 6> A;
  float variance = 0;
  for (int round = 0; round < kRounds; ++round) {
    A = kRidge * Eigen::Matrix<float, 6, 6>::Identity();
    Row b = Row::Zero();
    float sum = 0, squares = 0;
    for (const Sample& s : samples) {
      const float off = s.out - s.row.dot(c), error = round == 0 ? 0 : off / kScale;
      const float weight = 1 / (1 + error * error);
      A += weight * s.row * s.row.transpose();
      b += weight * s.out * s.row;
      sum += weight;
      squares += weight * off * off;
    }
    c = A.ldlt().solve(b);
    variance = squares / sum;
  }
  return {c, variance * A.inverse(), variance};
}

/// How far out a wall is at depths below its rim.
struct Profile {
  RawVector<float> down, out;
  std::size_t size = 0;

  explicit Profile(std::size_t most) : down(most + kPointPadding), out(most + kPointPadding) {}
  void add(float down_there, float out_there) {
    down[size] = down_there;
    out[size++] = out_there;
  }
};

/// A polynomial with n coefficients through it, as fit_surface() does it.
template <int n>
Fit<n> fit_polynomial(const Profile& profile) {
  const FacePoints points{profile.down.data(), profile.down.data(), profile.out.data(), profile.size};
  Eigen::Vector3f c = Eigen::Vector3f::Zero();
  Eigen::Matrix<float, n, n> A;
  float variance = 0;
  for (int round = 0; round < kRounds; ++round) {
    const ProfileSums s =
        point_kernels().sum_profile({{c[0], c[1], c[2], 0}, round == 0 ? 0 : 1 / kScale}, points);
    const Eigen::Matrix3f powers{{s.n, s.s, s.ss}, {s.s, s.ss, s.sss}, {s.ss, s.sss, s.ssss}};
    A = powers.topLeftCorner<n, n>() + kRidge * Eigen::Matrix<float, n, n>::Identity();
    c.head<n>() = A.ldlt().solve(Eigen::Vector3f(s.z, s.zs, s.zss).head<n>());
    variance = kScale * kScale * s.ee / s.n;
  }
  return {c.head<n>(), variance * A.inverse(), variance};
}

/// Straight unless a curve fits it clearly better: one through the noise on a straight wall is easily 10
/// degrees off at its end.
Fit<3> fit_profile(const Profile& profile) {
  constexpr float kClearly = 1.08f;  // of the variances
  const Fit<2> straight = fit_polynomial<2>(profile);
  Fit<3> curved = fit_polynomial<3>(profile);
  if (straight.variance > kClearly * curved.variance) return curved;
  Fit<3> fit{{straight.c[0], straight.c[1], 0}, Eigen::Matrix3f::Zero(), straight.variance};
  fit.covariance.topLeftCorner<2, 2>() = straight.covariance;
  return fit;
}

/// Standard error of what a row takes from the coefficients.
template <int n>
float standard_error(const Fit<n>& fit, const Eigen::Matrix<float, n, 1>& row) {
  return std::sqrt(std::max(0.0f, row.dot(fit.covariance * row)));
}

}  // namespace

std::optional<VesselAxis> vessel_axis(const SearchInput& in, std::span<const std::uint32_t> points,
                                      const Eigen::Vector3f& up) {
  constexpr std::size_t kMostPoints = 300, kMinWallPoints = 20;  // a spread sample says the same
  constexpr float kMinWallSine = 0.5f;                           // between a wall's normal and up
  constexpr float kLineScale = 0.008f;                           // of how far lines pass the axis [m]
  constexpr float kMaxSine = 0.25f;  // between a normal and the way to the axis, for a line that meets it
  constexpr float kMinShare = 0.6f;
  if (points.empty()) return std::nullopt;
  const Eigen::Vector3f u = up.unitOrthogonal(), v = up.cross(u), origin = in.cloud.point(points.front());
  std::pmr::vector<NormalLine> lines;
  const std::size_t step = (points.size() + kMostPoints - 1) / kMostPoints;
  for (std::size_t i = 0; i < points.size(); i += step) {
    const Eigen::Vector3f n = in.normals.at(points[i]), d = in.cloud.point(points[i]) - origin;
    const Eigen::Vector2f across(u.dot(n), v.dot(n));
    if (across.norm() > kMinWallSine) lines.push_back({{u.dot(d), v.dot(d)}, across.normalized()});
  }
  if (lines.size() < kMinWallPoints) return std::nullopt;
  const auto center = meeting_point(lines, kLineScale);
  if (!center) return std::nullopt;
  const auto meets = [&](const NormalLine& line) {
    return std::abs(line.passes(*center)) < kMaxSine * (line.p - *center).norm();
  };
  const auto num = std::count_if(lines.begin(), lines.end(), meets);
  if (static_cast<float>(num) < kMinShare * static_cast<float>(lines.size())) return std::nullopt;
  return VesselAxis{origin + center->x() * u + center->y() * v, up};
}

std::optional<RimWall> RimWall::fit(const SearchInput& in, std::span<const std::uint32_t> near,
                                    const Rim& rim, const std::optional<VesselAxis>& axis) {
  std::optional<RimWall> wall;
  if (axis) wall = fit_round(in, near, rim, *axis);
  return wall ? wall : fit_free(in, near, rim);
}

std::optional<RimWall> RimWall::fit_round(const SearchInput& in, std::span<const std::uint32_t> near,
                                          const Rim& rim, const VesselAxis& axis) {
  constexpr float kMinRadius = 0.015f, kMinRadial = 0.5f;
  const auto off_axis = [&](const Eigen::Vector3f& p) -> Eigen::Vector3f {
    const Eigen::Vector3f d = p - axis.center;
    return d - d.dot(axis.up) * axis.up;
  };
  const Eigen::Vector3f from_axis = off_axis(rim.p);
  const float radius = from_axis.norm();
  if (radius < kMinRadius || std::abs(from_axis.dot(rim.n)) < kMinRadial * radius) return std::nullopt;
  const float side = from_axis.dot(rim.n) < 0 ? -1.0f : 1.0f;  // the inside's normals point to the axis
  RimWall wall;
  wall.out_ = side / radius * from_axis;
  wall.up_ = axis.up;
  wall.along_ = wall.out_.cross(wall.up_);
  Profile profile(near.size());
  for (const std::uint32_t i : near) {
    const float below = axis.up.dot(rim.p - in.cloud.point(i));
    if (below < kEdge || below > kDeep) continue;
    const Eigen::Vector3f there = off_axis(in.cloud.point(i));
    const float r = there.norm();
    if (std::abs(r - radius) > kMaxAcross || side * there.dot(wall.out_) < kMinSector * r ||
        side * there.dot(in.normals.at(i)) < kMinRoundFacing * r)
      continue;
    profile.add(below / kDeep, side * (r - radius));
  }
  if (profile.size < kMinPoints) return std::nullopt;
  const Fit<3> fit = fit_profile(profile);
  wall.slopes_.y() = fit.c[1] / kDeep;
  wall.changes_.y() = 2 * fit.c[2] / (kDeep * kDeep);
  wall.error_rad_ = standard_error<3>(fit, {0, 1, 2 * kBetween}) / kDeep;
  return wall;
}

std::optional<RimWall> RimWall::fit_free(const SearchInput& in, std::span<const std::uint32_t> near,
                                         const Rim& rim) {
  RimWall wall;
  wall.out_ = rim.n;
  wall.up_ = rim.up;
  wall.along_ = rim.n.cross(rim.up);
  std::pmr::vector<Sample> samples;
  for (const std::uint32_t i : near) {
    const Eigen::Vector3f d = in.cloud.point(i) - rim.p;
    const float below = -rim.up.dot(d), aside = wall.along_.dot(d), out = rim.n.dot(d);
    if (below < kEdge || below > kDeep || std::abs(aside) > kMaxAside || std::abs(out) > kMaxAcross ||
        in.normals.at(i).dot(rim.n) < kMinFacing)
      continue;
    const float a = aside / kMaxAside, z = below / kDeep;
    Sample& sample = samples.emplace_back();
    sample.row << 1, a, z, a * a, z * z, a * z;
    sample.out = out;
  }
  if (samples.size() < kMinPoints) return std::nullopt;
  const Fit<6> fit = fit_surface(samples);
  const Row& c = fit.c;
  wall.slopes_ = {c[1] / kMaxAside, c[2] / kDeep};
  wall.changes_ = {c[5] / (kMaxAside * kDeep), 2 * c[4] / (kDeep * kDeep)};
  Row aside, down;
  aside << 0, 1, 0, 0, 0, kBetween;
  down << 0, 0, 1, 0, 2 * kBetween, 0;
  wall.error_rad_ = std::hypot(standard_error(fit, aside) / kMaxAside, standard_error(fit, down) / kDeep);
  return wall;
}

Eigen::Matrix3f RimWall::gripper_axes(float below_m) const {
  const Eigen::Vector2f slopes = slopes_ + below_m * changes_;
  Eigen::Matrix3f axes;
  axes.col(1) = (out_ - slopes.x() * along_ + slopes.y() * up_).normalized();
  axes.col(2) = (up_.dot(axes.col(1)) * axes.col(1) - up_).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return axes;
}

}  // namespace graspd
