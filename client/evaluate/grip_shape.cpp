// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/grip_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "client/evaluate/profile_fit.hpp"

namespace graspd {
namespace {

float tangent(float degrees) {
  return std::tan(degrees * std::numbers::pi_v<float> / 180);
}

constexpr float kMaxSideAngle_deg = 35;  // of a silhouette to the major axis
constexpr float kMaxWallAngle_deg = 30;  // of a wall to the approach, widening
constexpr float kSideSlice = 0.004f;
constexpr float kWallSlice = 0.003f;
constexpr float kMaxOffMiddle = 0.002f;  // of the object from the middle of the fingers, along the major axis
constexpr float kTipZone = 0.015f;       // above the fingertips, where the jaws press
constexpr float kNoise = 0.001f;         // of an extent over a slice
constexpr std::size_t kMinSlicePoints = 3;

constexpr float kFacing = 0.8f;        // cosine of 37 degrees
constexpr float kWedge = 0.57f;        // sine of 35 degrees
constexpr float kTurning = 0.2f;       // by which a round face turns towards the jaw over its last stretch
constexpr float kTowardsView = 0.26f;  // sine of 15 degrees
constexpr float kStrip = 0.006f;       // of points that are an end
constexpr float kNormalRadius = 0.009f;
constexpr float kMinWallArea = 2.5e-5f;
constexpr float kFaceReach = 0.020f;  // of the face behind an end

/// The largest value but for some stray ones.
float robust_max(std::vector<float>& values) {
  const std::size_t strays = std::min<std::size_t>(values.size() / 10, 2);
  const auto at = values.end() - 1 - static_cast<std::ptrdiff_t>(strays);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Largest side * y in slices of one coordinate; nothing where a slice has hardly a point.
std::vector<std::optional<float>> profile(const GripShape& shape, int side, int coordinate, float from,
                                          float slice, std::size_t slices) {
  std::vector<std::vector<float>> values(slices);
  for (const Eigen::Vector3f& p : shape.between) {
    const float at = (p[coordinate] - from) / slice;
    if (at >= 0 && at < static_cast<float>(slices))
      values[static_cast<std::size_t>(at)].push_back(static_cast<float>(side) * p.y());
  }
  std::vector<std::optional<float>> result(slices);
  for (std::size_t k = 0; k < slices; ++k)
    if (values[k].size() >= kMinSlicePoints) result[k] = robust_max(values[k]);
  return result;
}

/// Slope of a line through the profile; zero for fewer than three slices.
float slope(const std::vector<std::optional<float>>& profile, float slice) {
  float n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    if (!profile[k]) continue;
    const float x = static_cast<float>(k) * slice, y = *profile[k];
    n += 1;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const float spread = n * sxx - sx * sx;
  return n < 3 || spread <= 0 ? 0 : (n * sxy - sx * sy) / spread;
}

/// By how much the object widens on one side over the last stretch above the fingertips, as a slope.
float widening(const GripShape& shape, int side) {
  const GripGeometry& g = shape.geometry;
  const auto slices = static_cast<std::size_t>(std::ceil((g.tip() - g.palm()) / kWallSlice));
  const float from = g.tip() - static_cast<float>(slices) * kWallSlice;
  const auto extents = profile(shape, side, 2, from, kWallSlice, slices);
  const auto zone = static_cast<std::size_t>(kTipZone / kWallSlice);
  // The jaws close on the widest place, wherever it is.
  std::optional<float> above, all;
  for (std::size_t k = 0; k < slices; ++k) {
    if (!extents[k]) continue;
    all = std::max(all.value_or(*extents[k]), *extents[k]);
    if (k + zone < slices) above = all;
  }
  return above ? (*all - *above - kNoise) / kTipZone : 0;
}

/// Points that lie within a range behind the end, along the closing axis.
std::vector<Eigen::Vector3f> strip(const GripShape& shape, int side, float from, float to) {
  const auto s = static_cast<float>(side);
  std::vector<float> values;
  for (const Eigen::Vector3f& p : shape.between) values.push_back(s * p.y());
  const float end = robust_max(values);
  std::vector<Eigen::Vector3f> points;
  for (const Eigen::Vector3f& p : shape.between) {
    const float behind = end - s * p.y();
    if (behind >= from && behind < to) points.push_back(p);
  }
  return points;
}

/// How much the surface at some points faces the jaw.
struct Facing {
  float mean = 0;  ///< cosine between normal and closing axis
  int points = 0;
  int walls = 0;  ///< points where it is a wall
};

Facing facing(const GripShape& shape, const std::vector<Eigen::Vector3f>& points, int side) {
  Facing result;
  for (const Eigen::Vector3f& p : points) {
    const auto normal = plane_normal(neighbors(shape.around, p, kNormalRadius), shape.viewpoint);
    if (!normal) continue;
    const float cosine = normal->y() * static_cast<float>(side);
    result.mean += cosine;
    result.walls += cosine >= kFacing ? 1 : 0;
    ++result.points;
  }
  if (result.points > 0) result.mean /= static_cast<float>(result.points);
  return result;
}

/// The face that ends in the strip: its normal, from the points up to kFaceReach behind it.
std::optional<Eigen::Vector3f> face_normal(const GripShape& shape, const JawContact& contact, int side) {
  std::vector<Eigen::Vector3f> face;
  for (const Eigen::Vector3f& p : shape.between)
    if (static_cast<float>(side) * (contact.end.y() - p.y()) < kFaceReach) face.push_back(p);
  return plane_normal(face, shape.viewpoint);
}

/// A flat face ends at a wall at right angles to it: where is that at the depth of the fingertips?
bool flat_face_clear(const GripShape& shape, const JawContact& contact, const Eigen::Vector3f& normal,
                     int side) {
  const float into = -normal.z();
  if (into < 0.3f) return false;  // the face runs along the approach
  const float outward = -normal.y() * static_cast<float>(side) / into;
  const float depth = std::max(shape.geometry.tip() - contact.end.z(), 0.0f);
  float end = std::numeric_limits<float>::lowest();
  for (const Eigen::Vector3f& p : contact.border) end = std::max(end, static_cast<float>(side) * p.y());
  return end + outward * depth <= shape.geometry.half_opening() + 0.001f;
}

/// A curved face goes on as its circle.
bool round_face_clear(const GripShape& shape, int side) {
  const std::optional<Circle> circle = fit_circle(shape.between);
  if (!circle) return false;
  const float tip = shape.geometry.tip();
  const float below = std::max(circle->z - tip, 0.0f);  // the middle is deeper than the fingertips
  if (below > 0.6f * circle->radius) return false;      // they would press on a slope
  const float reach = std::sqrt(circle->radius * circle->radius - below * below);
  return static_cast<float>(side) * circle->y + reach <= shape.geometry.half_opening() + 0.001f;
}

}  // namespace

bool sides_hold(const GripShape& shape) {
  const auto [first, last] = std::minmax_element(shape.between.begin(), shape.between.end(),
                                                 [](const auto& a, const auto& b) { return a.x() < b.x(); });
  if (first->x() > kMaxOffMiddle || last->x() < -kMaxOffMiddle) return false;
  const float from = -shape.geometry.half_thickness();
  const auto slices = static_cast<std::size_t>(std::ceil(-2 * from / kSideSlice));
  for (const int side : {-1, 1}) {
    const float angle = slope(profile(shape, side, 0, from, kSideSlice, slices), kSideSlice);
    if (std::abs(angle) > tangent(kMaxSideAngle_deg)) return false;
  }
  return true;
}

bool walls_hold(const GripShape& shape) {
  return widening(shape, -1) <= tangent(kMaxWallAngle_deg) &&
         widening(shape, 1) <= tangent(kMaxWallAngle_deg);
}

JawContact find_contact(const GripShape& shape, int side) {
  JawContact contact;
  contact.border = strip(shape, side, std::numeric_limits<float>::lowest(), kStrip);
  for (const Eigen::Vector3f& p : contact.border)
    contact.end += p / static_cast<float>(contact.border.size());
  const Facing end = facing(shape, contact.border, side);
  contact.wall_seen = static_cast<float>(end.walls) * shape.point_area_m2 >= kMinWallArea;
  const Eigen::Vector3f to_view = (shape.viewpoint - contact.end).normalized();
  contact.towards_viewpoint = to_view.y() * static_cast<float>(side) > kTowardsView;
  contact.sloping = end.points == 0 || end.mean > kWedge;
  const Facing before = facing(shape, strip(shape, side, kStrip, 2 * kStrip), side);
  contact.turning = before.points > 0 && end.mean - before.mean > kTurning;
  const auto face = face_normal(shape, contact, side);
  contact.carried_on_clear = (face && !contact.sloping && flat_face_clear(shape, contact, *face, side)) ||
                             round_face_clear(shape, side);
  return contact;
}

float seen_area(const GripShape& shape) {
  return shape.point_area_m2 * static_cast<float>(shape.between.size());
}

float top_of(const GripShape& shape) {
  std::vector<float> heights;
  for (const Eigen::Vector3f& p : shape.between) heights.push_back(-p.z());
  return -robust_max(heights);
}

}  // namespace graspd
