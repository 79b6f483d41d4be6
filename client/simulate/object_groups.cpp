// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/object_groups.hpp"

#include <algorithm>
#include <cmath>

#include "client/simulate/placement.hpp"

namespace graspd {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Box& box_of(const ObjectModel& model) {
  return std::get<Box>(model.solid.parts.front());
}

ObjectModel shifted(ObjectModel model, const Vector2d& by, double yaw_rad, double up) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << by, up;
  T.rotate(Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ()));
  model.solid.T_world_solid = T * model.solid.T_world_solid;
  for (Footprint& f : model.footprints) f = moved(f, by, yaw_rad, up);
  model.top_half.reset();
  return model;
}

/// Centred about x = 0, so that a row's place is its middle.
void centre(std::vector<ObjectModel>& row, double length) {
  for (ObjectModel& model : row) model = shifted(std::move(model), {-length / 2, 0}, 0, 0);
}

/// A standing box against what ends at x, height below; its top leans towards -x until it touches.
ObjectModel leaning(ObjectModel model, double x, double below, double lean_rad) {
  const Vector3d size = 2 * box_of(model).half;
  const double sine = std::sin(lean_rad), cosine = std::cos(lean_rad);
  const double pivot = x + std::min(size.z() * cosine, below) * std::tan(lean_rad);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Vector3d(pivot, 0, 0);
  T.rotate(Eigen::AngleAxisd(-lean_rad, Vector3d::UnitY()));
  T.translate(Vector3d(size.x() / 2, 0, 0));
  model.solid.T_world_solid = T * model.solid.T_world_solid;
  const double low = pivot - size.z() * sine, high = pivot + size.x() * cosine;
  Footprint f;
  f.center = Vector2d((low + high) / 2, 0);
  f.half = Vector2d((high - low) / 2, size.y() / 2);
  f.z_max = size.z() * cosine + size.x() * sine;
  model.footprints = {f};
  model.top_half.reset();
  return model;
}

}  // namespace

std::vector<ObjectModel> make_book_row(Rng& rng) {
  std::vector<ObjectModel> row;
  const int num = 3 + rng.index(4);
  double x = 0;
  for (int i = 0; i < num; ++i) {
    ObjectModel book = make_standing_book(rng);
    const Vector3d half = box_of(book).half;
    row.push_back(shifted(std::move(book), {x + half.x(), rng.uniform(-0.015, 0.015)}, 0, 0));
    x += 2 * half.x() + kTouchGap;
  }
  if (rng.uniform() < 0.6) {
    const double below = row.back().footprints.front().z_max;
    row.push_back(leaning(make_standing_book(rng), x, below, rng.uniform(0.12, 0.40)));
    row.back().solid.kind = "leaning_book";
    x = row.back().footprints.front().center.x() + row.back().footprints.front().half.x();
  }
  centre(row, x);
  return row;
}

std::vector<ObjectModel> make_box_row(Rng& rng) {
  std::vector<ObjectModel> row;
  const int num = 2 + rng.index(3);
  double x = 0;
  for (int i = 0; i < num; ++i) {
    ObjectModel box = make_box(rng);
    const Vector3d half = box_of(box).half;
    row.push_back(shifted(std::move(box), {x + half.x(), rng.uniform(-0.02, 0.02)}, 0, 0));
    x += 2 * half.x() + kTouchGap;
  }
  centre(row, x);
  return row;
}

std::vector<ObjectModel> make_book_pile(Rng& rng) {
  std::vector<ObjectModel> pile;
  const int num = 2 + rng.index(3);
  double up = 0;
  for (int i = 0; i < num; ++i) {
    ObjectModel book = make_book(rng);
    const double height = book.top_z;
    const Vector2d aside(rng.uniform(-0.012, 0.012), rng.uniform(-0.012, 0.012));
    pile.push_back(shifted(std::move(book), aside, rng.uniform(-0.2, 0.2), up));
    up += height;
  }
  return pile;
}

}  // namespace graspd
