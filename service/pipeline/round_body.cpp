// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/round_body.hpp"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "service/pipeline/normal_lines.hpp"

namespace graspd {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr std::size_t kMostPoints = 200;  // a spread sample says the same
constexpr std::size_t kMinPoints = 32;    // on walls, of the sample
constexpr float kMinWallSine = 0.6f;      // between a wall's normal and the axis
constexpr float kMostWallCosine = 0.6f;
constexpr float kLineScale = 0.004f;    // of how far lines along normals pass the axis [m]
constexpr float kRadiusScale = 0.002f;  // of how far points are from their slice's radius [m]
constexpr float kNearLine = 0.005f;     // a line that meets the axis [m]
constexpr float kMinLineShare = 0.5f;   // noise turns normals: by 8 degrees it is 6 mm on a can
constexpr float kUpright = 1.1f;        // by which the axis that is known counts more than one that is not
constexpr float kTiltLength = 0.05f;    // that makes tilts as large as shifts [m]
constexpr float kNear = 0.0025f;        // a point that belongs to its slice [m]
constexpr float kMinNearShare = 0.8f;
constexpr float kSurelyShare = 0.95f;  // no other axis needs to be tried
constexpr float kMaxRadius = 0.09f;
constexpr int kMostSlices = 96;

struct WallPoint {
  Vector2f p, normal;  // across the axis; the normal's is unit length
  float along, lean;
  int slice;
};

float weight(float error, float scale) {
  const float e = error / scale;
  return 1 / (1 + e * e);
}

/// The walls of an object as an axis sees them.
class Walls {
 public:
  Walls(const PointCloud& cloud, const Normals& normals, std::span<const std::uint32_t> points,
        const Vector3f& axis)
      : axis_(axis), across_(axis.unitOrthogonal()), origin_(cloud.point(points.front())) {
    const Vector3f third = axis_.cross(across_);
    const std::size_t step = (points.size() + kMostPoints - 1) / kMostPoints;
    float lowest = 0, sum = 0;
    for (std::size_t i = 0; i < points.size(); i += step) {
      const Vector3f n = normals.at(points[i]);
      const Vector2f n2(n.dot(across_), n.dot(third));
      const float sine = n2.norm();
      if (!(sine >= kMinWallSine)) continue;
      const Vector3f p = cloud.point(points[i]) - origin_;
      points_[size_++] = {{p.dot(across_), p.dot(third)}, n2 / sine, p.dot(axis_), n.dot(axis_), 0};
      lowest = std::min(lowest, points_[size_ - 1].along);
      sum += points_[size_ - 1].along;
    }
    first_ = lowest;
    middle_ = sum / static_cast<float>(std::max<std::size_t>(1, size_));
    for (WallPoint& w : walls())
      w.slice = std::min(kMostSlices - 1, static_cast<int>((w.along - first_) / kRoundSlice));
  }

  [[nodiscard]] std::size_t size() const { return size_; }

  /// Where lines along the normals meet. False where they are too parallel to tell.
  bool meet_lines() {
    std::array<NormalLine, kMostPoints> lines;
    for (std::size_t i = 0; i < size_; ++i) lines[i] = {points_[i].p, points_[i].normal};
    const auto center = meeting_point({lines.data(), size_}, kLineScale);
    if (!center) return false;
    center_ = *center;
    const auto meets = [&](const NormalLine& line) { return std::abs(line.passes(center_)) < kNearLine; };
    const auto near = std::count_if(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(size_), meets);
    return static_cast<float>(near) >= kMinLineShare * static_cast<float>(size_);
  }

  /// Moves the axis so that each slice is as round as can be, and tilts it unless it is known which way it
  /// goes.
  void make_round(bool may_tilt) {
    for (int round = 0; round < 4; ++round) {
      measure_slices();
      Eigen::Matrix4f A = Eigen::Matrix4f::Identity() * 1e-2f;
      Eigen::Vector4f b = Eigen::Vector4f::Zero();
      for (const WallPoint& w : walls()) {
        const Slice& s = slices_[static_cast<std::size_t>(w.slice)];
        const Vector2f way = w.p - center_at(w), out = way.normalized() - s.out;
        const float error = way.norm() - s.radius, u = weight(error, kRadiusScale);
        const float tilted = may_tilt ? (w.along - middle_) / kTiltLength : 0;
        const Eigen::Vector4f slope(out.x(), out.y(), tilted * out.x(), tilted * out.y());
        A += u * slope * slope.transpose();
        b += u * error * slope;
      }
      const Eigen::Vector4f step = A.ldlt().solve(b);
      center_ += Vector2f(step[0], step[1]);
      tilt_ += Vector2f(step[2], step[3]) / kTiltLength;
    }
    measure_slices();
  }

  /// Points that belong to their slices, as a share of all.
  [[nodiscard]] float near_share() const {
    std::size_t near = 0;
    for (const WallPoint& w : walls()) near += belongs(w) ? 1 : 0;
    return static_cast<float>(near) / static_cast<float>(size_);
  }

  [[nodiscard]] RoundBody body() const {
    RoundBody body;
    const Vector3f third = axis_.cross(across_);
    body.axis = (axis_ + tilt_.x() * across_ + tilt_.y() * third).normalized();
    body.center = origin_ + center_.x() * across_ + center_.y() * third + middle_ * axis_;
    std::array<RoundSlice, kMostSlices> sums{};
    std::array<int, kMostSlices> counts{};
    for (const WallPoint& w : walls()) {
      if (!belongs(w)) continue;
      RoundSlice& s = sums[static_cast<std::size_t>(w.slice)];
      s.along_m += w.along - middle_;
      s.radius_m += (w.p - center_at(w)).norm();
      s.lean += w.lean;
      ++counts[static_cast<std::size_t>(w.slice)];
    }
    for (std::size_t k = 0; k < kMostSlices; ++k) {
      const auto n = static_cast<float>(counts[k]);
      if (counts[k] >= 3)
        body.slices.push_back({sums[k].along_m / n, sums[k].radius_m / n, sums[k].lean / n});
    }
    return body;
  }

 private:
  struct Slice {
    float radius = 0, weight = 0;
    Vector2f out = Vector2f::Zero();  // mean direction from the axis
  };

  [[nodiscard]] std::span<WallPoint> walls() { return {points_.data(), size_}; }
  [[nodiscard]] std::span<const WallPoint> walls() const { return {points_.data(), size_}; }

  /// Where the axis passes the height of a point.
  [[nodiscard]] Vector2f center_at(const WallPoint& w) const { return center_ + (w.along - middle_) * tilt_; }

  [[nodiscard]] bool belongs(const WallPoint& w) const {
    const Vector2f out = w.p - center_at(w);
    const float radius = out.norm();
    return out.dot(w.normal) > 0.8f * radius && radius < kMaxRadius &&
           std::abs(radius - slices_[static_cast<std::size_t>(w.slice)].radius) <= kNear;
  }

  void measure_slices() {
    const std::array<Slice, kMostSlices> before = slices_;
    slices_.fill({});
    for (const WallPoint& w : walls()) {
      const Vector2f out = w.p - center_at(w);
      const float radius = out.norm();
      const Slice& known = before[static_cast<std::size_t>(w.slice)];
      const float u = known.weight > 0 ? weight(radius - known.radius, kRadiusScale) : 1;
      Slice& s = slices_[static_cast<std::size_t>(w.slice)];
      s.weight += u;
      s.radius += u * radius;
      s.out += u * out.normalized();
    }
    for (Slice& s : slices_) {
      if (s.weight <= 0) continue;
      s.radius /= s.weight;
      s.out /= s.weight;
    }
  }

  Vector3f axis_, across_, origin_;
  float first_ = 0, middle_ = 0;  // along the axis
  std::array<WallPoint, kMostPoints> points_;
  std::size_t size_ = 0;
  Vector2f center_ = Vector2f::Zero(), tilt_ = Vector2f::Zero();
  std::array<Slice, kMostSlices> slices_{};
};

/// Principal axes of those normals that are at least as far from a direction as a wall's, smallest first.
Eigen::Matrix3f principal_axes(const Normals& normals, std::span<const std::uint32_t> points,
                               const Vector3f& direction) {
  Eigen::Matrix3f scatter = Eigen::Matrix3f::Zero();
  const std::size_t step = (points.size() + kMostPoints - 1) / kMostPoints;
  for (std::size_t i = 0; i < points.size(); i += step) {
    const Vector3f n = normals.at(points[i]);
    if (std::abs(n.dot(direction)) < kMostWallCosine) scatter += n * n.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f>(scatter).eigenvectors();
}

/// Seen from one side, a body has its axis near one of the principal axes of its normals, and that of its
/// walls alone is nearer.
std::array<Vector3f, 3> likely_axes(const Normals& normals, std::span<const std::uint32_t> points) {
  const Eigen::Matrix3f rough = principal_axes(normals, points, Vector3f::Zero());
  std::array<Vector3f, 3> axes;
  for (int k = 0; k < 3; ++k) {
    Vector3f& axis = axes[static_cast<std::size_t>(k)];
    axis = rough.col(k);
    for (int round = 0; round < 2; ++round) axis = principal_axes(normals, points, axis).col(0);
  }
  return axes;
}

}  // namespace

std::optional<RoundBody> fit_round_body(const PointCloud& cloud, const Normals& normals,
                                        std::span<const std::uint32_t> points,
                                        const std::optional<Eigen::Vector3f>& up) {
  if (points.size() < kMinPoints) return std::nullopt;
  const std::array<Vector3f, 3> axes = likely_axes(normals, points);
  std::optional<RoundBody> best;
  float most = 0;
  for (int k = up ? -1 : 0; k < 3; ++k) {
    Walls walls(cloud, normals, points, k < 0 ? *up : axes[static_cast<std::size_t>(k)]);
    if (walls.size() < kMinPoints || !walls.meet_lines()) continue;
    walls.make_round(k >= 0);
    const float share = walls.near_share();
    const float near = share * static_cast<float>(walls.size()) * (k < 0 ? kUpright : 1);
    if (share < kMinNearShare || near <= most) continue;
    most = near;
    best = walls.body();
    if (share > kSurelyShare) break;
  }
  return best;
}

}  // namespace graspd
