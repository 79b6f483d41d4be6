// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/model_parts.hpp"

#include <array>

namespace graspd {
namespace {

using Eigen::Vector2d;

std::uint32_t random_color(Rng& rng) {
  constexpr std::array<std::uint32_t, 14> kPaints{0xc0392b, 0xe67e22, 0xf1c40f, 0x27ae60, 0x16a085,
                                                  0x2980b9, 0x8e44ad, 0x34495e, 0xecf0f1, 0xd35400,
                                                  0x7f8c8d, 0xb9770e, 0x5dade2, 0xf5b7b1};
  return rng.pick(kPaints);
}

}  // namespace

ObjectModel with_part(const char* kind, Rng& rng, const Convex& part) {
  ObjectModel model;
  model.solid.kind = kind;
  model.solid.rgb = random_color(rng);
  model.solid.parts.push_back(part);
  return model;
}

Footprint circle(double radius, double height) {
  Footprint f;
  f.radius = radius;
  f.z_max = height;
  return f;
}

Footprint rectangle(const Vector2d& center, const Vector2d& half, double height) {
  Footprint f;
  f.center = center;
  f.half = half;
  f.z_max = height;
  return f;
}

void lay_down(ObjectModel& model, double middle, double height) {
  model.solid.T_world_solid.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  model.solid.T_world_solid.translation() = Eigen::Vector3d(-middle, 0, height);
}

}  // namespace graspd
