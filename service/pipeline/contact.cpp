// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/contact.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace graspd {
namespace {

constexpr float kEndZone = 0.004f;       // points this close to the end are the end [m]
constexpr float kFaceLength = 0.030f;    // of the face that is carried on [m]
constexpr float kWallShare = 0.30f;      // of the end's points that must face the jaw
constexpr float kSeenFree = 0.18f;       // up to this hidden share a place counts as seen to be free
constexpr float kHidden = 0.30f;         // from this share on as hidden; between the two it must do as both
constexpr float kMinFaceArea = 0.8e-4f;  // seen, of a face that is carried on [m2]
constexpr float kMaxRise = 0.50f;      // of a face towards its end: one that curls up is not understood [rad]
constexpr float kCameraSide = 0.40f;   // cosine: beyond it the sensor would have seen the wall
constexpr float kMaxWedge = 0.65f;     // mean tilt of a face that ends at free space [rad]
constexpr float kMaxFlatTilt = 0.40f;  // tilt of a flat face that is carried on [rad]
constexpr float kMaxDoubt = 0.006f;    // between two guesses at where a round face ends [m]
constexpr float kMinTurn = 0.05f;      // of a face that is not flat [rad]
constexpr float kMinTurningSpan = 0.013f;  // along a shorter one only its edges turn [m]
constexpr float kMaxUnseenBulge = 0.012f;  // beyond an edge beside seen space [m]
constexpr float kSeenThrough = 0.003f;     // a place this far behind what is seen is not seen to be free [m]

/// z = c0 + c1 in + c2 in^2 (+ c3 a) by iteratively reweighted least squares (Cauchy weights, scale 2 mm). A
/// face may be tilted along the major axis, too, by more than what its profile is asked for. Lengths are
/// scaled, those of the face too, to keep the normal equations well conditioned.
Eigen::Vector3f fit_profile(EndFace& face, float span) {
  constexpr float kScale = 0.002f;
  for (std::size_t i = 0; i < face.size; ++i) {
    face.in[i] /= span;
    face.a[i] /= span;
  }
  Eigen::Vector4f c = Eigen::Vector4f::Zero();
  for (int round = 0; round < 5; ++round) {
    const ProfileSums s =
        point_kernels().sum_profile({{c[0], c[1], c[2], c[3]}, round == 0 ? 0 : 1 / kScale},
                                    {face.in.data(), face.a.data(), face.z.data(), face.size});
    Eigen::Matrix4f A = Eigen::Matrix4f::Identity() * 1e-6f;
    A += Eigen::Matrix4f{{s.n, s.s, s.ss, s.a},
                         {s.s, s.ss, s.sss, s.as},
                         {s.ss, s.sss, s.ssss, s.ass},
                         {s.a, s.as, s.ass, s.aa}};
    c = A.ldlt().solve(Eigen::Vector4f(s.z, s.zs, s.zss, s.za));
  }
  return {c[0], c[1] / span, c[2] / (span * span)};
}

struct EndPoints {
  int near = 0, facing = 0, seen = 0;
  Eigen::Vector3f facing_sum = Eigen::Vector3f::Zero();  // of the normals
};

EndPoints collect_end(const ContactInput& in, float side, float end_m, float min_upright, EndFace& face) {
  EndPoints out;
  face.start(in.between.size());
  const float length = std::min(kFaceLength, 0.7f * in.extent_m);
  const Eigen::Vector3f jaw = side * in.rotation.col(1), approach = in.rotation.col(2);
  for (const std::uint32_t k : in.between) {
    const float inwards = side * (end_m - in.local.f[k]);
    if (inwards < 0 || inwards > length) continue;
    const Eigen::Vector3f n = in.scene.normal(in.local.index[k]);
    if (n.isZero()) continue;
    if (inwards <= kEndZone) {
      ++out.near;
      out.seen += in.scene.is_seen(in.local.index[k]) ? 1 : 0;
      if (jaw.dot(n) >= in.min_facing_cosine) {
        ++out.facing;
        out.facing_sum += n;
      }
    }
    if (-approach.dot(n) >= min_upright) face.add(inwards, in.local.z[k], in.local.a[k]);
  }
  return out;
}

bool too_small(const ContactInput& in, const EndFace& face) {
  return face.size < 8 || static_cast<float>(face.size) * in.area_per_point_m2 < kMinFaceArea;
}

/// Whether something nearer hides what comes after the end, which then is no edge of the object.
bool ends_by_occlusion(const ContactInput& in, float side, float end_m, float end_depth_m) {
  int hidden = 0;
  for (const float a : {-0.3f, 0.0f, 0.3f}) {
    const Eigen::Vector3f beyond(a * in.finger_thickness_m, end_m + side * 0.006f, end_depth_m);
    hidden +=
        in.scene.depth_map.hider(in.position + in.rotation * beyond, DepthMap::kHideMargin) != DepthMap::kFree
            ? 1
            : 0;
  }
  return hidden >= 2;
}

/// How far out the circle that turns as the face does between its inner tilt and the one at its end goes.
std::optional<float> turning_reach(float side, float end_m, float at_end, float inner, float middle,
                                   float span) {
  const float turn = at_end - inner;
  if (turn <= kMinTurn || span < kMinTurningSpan) return std::nullopt;
  const float radius = span / (std::cos(middle) * turn);
  if (radius >= kMaxRadius) return std::nullopt;
  return end_m + side * radius * (1 - std::sin(at_end));
}

/// How far out a curved face goes on: the circle through the whole profile, where there is one, says it best;
/// what the face itself suggests beyond that, up to a bound, is kept clear of too. Nothing where it is flat.
std::optional<float> round_reach(const ContactInput& in, float side, float end_m,
                                 const std::optional<float>& turning) {
  if (!in.circle) return turning;
  const float below = std::max(0.0f, in.circle->center.y() - in.depth_m), r = in.circle->radius;
  const float half = std::sqrt(std::max(0.0f, r * r - below * below));
  const float circle = std::max(side * end_m, side * in.circle->center.x() + half);
  const float more = turning ? std::clamp(side * *turning - circle, 0.0f, kMaxDoubt) : 0.0f;
  return side * (circle + more);
}

/// Whether the jaws meet a round object so far above its widest place that they slide off.
bool slips_off(const ContactInput& in) {
  return in.circle &&
         in.circle->center.y() - in.depth_m > in.circle->radius * std::sin(in.max_wall_angle_rad);
}

/// How much of a bulge beyond the end there can be: it ends where the sensor looks through at all depths.
float unseen_bulge(const ContactInput& in, float side, float end_m, float end_depth_m, float bulge_m) {
  constexpr int kSteps = 4, kMostOfThree = 2;
  constexpr float kDepths = static_cast<float>(kProbes);
  Probes places;
  std::int32_t hiders[kProbes];
  for (int step = 1; step <= kSteps; ++step) {
    const float beyond = bulge_m * static_cast<float>(step) / kSteps;
    int hidden[kProbes] = {};
    for (const float a : {-0.3f, 0.0f, 0.3f}) {
      for (std::size_t k = 0; k < kProbes; ++k) {
        const float z = end_depth_m + (in.depth_m - end_depth_m) * (static_cast<float>(k) + 0.5f) / kDepths;
        const Eigen::Vector3f p =
            in.position + in.rotation * Eigen::Vector3f(a * in.finger_thickness_m, end_m + side * beyond, z);
        places.x[k] = p.x();
        places.y[k] = p.y();
        places.z[k] = p.z();
      }
      in.scene.depth_map.find_hiders(places, kSeenThrough, hiders);
      for (std::size_t k = 0; k < kProbes; ++k) hidden[k] += hiders[k] != DepthMap::kFree ? 1 : 0;
    }
    if (std::none_of(hidden, hidden + kProbes, [](int n) { return n >= kMostOfThree; }))
      return bulge_m * static_cast<float>(step - 1) / kSteps;
  }
  return bulge_m;
}

/// A face whose wall is out of sight: which way it goes on decides.
Contact edge_contact(const ContactInput& in, float side, float end_m, float hidden_share, EndFace& face) {
  float span = 1e-3f;
  for (std::size_t i = 0; i < face.size; ++i) span = std::max(span, face.in[i]);
  const Eigen::Vector3f c = fit_profile(face, span);
  // Tilts of the face at the end, at the far side of the fitted part and between: positive falls away towards
  // the end.
  const float at_end = std::atan(-c[1]), inner = std::atan(-c[1] - 2 * c[2] * span);
  const float middle = std::atan(-c[1] - c[2] * span);
  if (ends_by_occlusion(in, side, end_m, c[0])) return {ContactKind::kNone, end_m, {}};
  if (at_end < -kMaxRise) return {ContactKind::kNone, end_m, {}};
  const std::optional<float> round_end =
      round_reach(in, side, end_m, turning_reach(side, end_m, at_end, inner, middle, span));
  const bool no_wedge = std::abs(0.5f * (at_end + inner)) <= kMaxWedge;
  // Even where the place beside it is seen, the widest place of a round object may lie below what is;
  // anywhere between the edge and what the face suggests, so that their middle is the least wrong; where the
  // whole profile is a circle, there.
  float bulge = round_end ? std::min(kMaxUnseenBulge, side * (*round_end - end_m)) : 0;
  if (bulge > 0 && hidden_share <= kSeenFree) bulge = unseen_bulge(in, side, end_m, c[0], bulge);
  const float free_end = end_m + side * (in.circle ? 1.0f : 0.5f) * bulge;
  if (hidden_share <= kSeenFree) return {no_wedge ? ContactKind::kFreeEdge : ContactKind::kNone, free_end};
  if (hidden_share < kHidden && !no_wedge) return {ContactKind::kNone, end_m, {}};
  if (round_end) return {slips_off(in) ? ContactKind::kNone : ContactKind::kCurvedEdge, *round_end};
  const float lean = std::max(0.0f, (in.depth_m - c[0]) * std::tan(-middle));
  return {std::abs(middle) <= kMaxFlatTilt ? ContactKind::kFlatEdge : ContactKind::kNone,
          end_m + side * lean};
}

/// Whether the sensor saw something well behind most places just beyond the end, below its height: where a
/// face is missing nothing is seen.
bool is_seen_through(const ContactInput& in, float side, float end_m) {
  constexpr float kBelow = 0.002f, kBehind = 0.010f, kAnywhere = 1e3f;
  constexpr int kLeast = 4;  // of the six places
  int through = 0;
  for (const float a : {-0.3f, 0.0f, 0.3f})
    for (const float beyond : {0.006f, 0.010f}) {
      const Eigen::Vector3f place =
          in.position +
          in.rotation * Eigen::Vector3f(a * in.finger_thickness_m, end_m + side * beyond, in.top_m + kBelow);
      through += in.scene.depth_map.hider(place, -kBehind) == DepthMap::kFree &&
                         in.scene.depth_map.hider(place, -kAnywhere) != DepthMap::kFree
                     ? 1
                     : 0;
    }
  return through >= kLeast;
}

/// Whether what is between the jaws is the edge of a thin wall that ends here: a plate's other face is out of
/// sight, and what is seen of its edge is too narrow for a face of its own.
bool is_thin_edge(const ContactInput& in, float side, float end_m) {
  constexpr float kThin = 0.012f, kEdgeDepth = 0.006f;
  if (!is_plate(in.extent_m, in.depth_m - in.top_m)) return false;
  int near = 0, high = 0;
  float low = end_m, far = end_m;
  for (const std::uint32_t k : in.between) {
    const bool is_high = in.local.z[k] <= in.top_m + kEdgeDepth;
    if (is_high) {
      low = std::min(low, in.local.f[k]);
      far = std::max(far, in.local.f[k]);
    }
    if (side * (end_m - in.local.f[k]) > kEndZone) continue;
    ++near;
    high += is_high ? 1 : 0;
  }
  return far - low <= kThin && 2 * high >= near && is_seen_through(in, side, end_m);
}

}  // namespace

float circle_tolerance(const SceneView& scene) {
  constexpr float kLeast = 0.0015f, kMost = 0.0035f, kSigmas = 2;  // [m]
  return scene.support ? std::min(kMost, kLeast + kSigmas * scene.support->sigma_m) : kMost;
}

Contact find_contact(const ContactInput& in, float side, float end_m, float hidden_share, EndFace& face) {
  const EndPoints end = collect_end(in, side, end_m, hidden_share <= kSeenFree ? 0.5f : 0.7f, face);
  if (end.near < 2) return {ContactKind::kNone, end_m, {}};
  if (static_cast<float>(end.facing) >= kWallShare * static_cast<float>(end.near))
    return {2 * end.seen >= end.near ? ContactKind::kWall : ContactKind::kCurvedEdge, end_m,
            in.rotation.transpose() * end.facing_sum.normalized()};
  const Eigen::Vector3f to_sensor = (in.scene.cloud.viewpoint - in.position).normalized();
  if (side * in.rotation.col(1).dot(to_sensor) > kCameraSide) return {ContactKind::kNone, end_m, {}};
  if (is_thin_edge(in, side, end_m)) return {ContactKind::kThinEdge, end_m, {}};
  // A far side that turns away from the jaw is none to hold by.
  if (2 * end.seen < end.near || too_small(in, face)) return {ContactKind::kNone, end_m, {}};
  return edge_contact(in, side, end_m, hidden_share, face);
}

}  // namespace graspd
