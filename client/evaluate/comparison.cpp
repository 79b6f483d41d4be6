// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "client/evaluate/evaluator.hpp"

namespace graspd {
namespace {

constexpr float kSamePlace = 0.010f;  // [m]
constexpr float kSameTurn = 15 * std::numbers::pi_v<float> / 180;

/// A parallel gripper is the same when turned by half a turn about its approach.
bool is_same_place(const Handle& a, const Handle& b) {
  if ((a.position - b.position).norm() > kSamePlace) return false;
  const Eigen::Matrix3f turn = a.rotation.transpose() * b.rotation;
  const Eigen::Matrix3f half =
      Eigen::AngleAxisf(std::numbers::pi_v<float>, Eigen::Vector3f::UnitZ()).matrix();
  return std::min(Eigen::AngleAxisf(turn).angle(), Eigen::AngleAxisf(turn * half).angle()) <= kSameTurn;
}

bool is_matched(const JudgedHandle& handle, const JudgedFrame& other) {
  return std::any_of(other.handles.begin(), other.handles.end(), [&](const JudgedHandle& candidate) {
    return candidate.valid && is_same_place(handle.handle, candidate.handle);
  });
}

void add_object_rows(const JudgedFrame& one, const JudgedFrame& other, const std::string& run, Table& table) {
  const auto mine = object_outcomes(one), theirs = object_outcomes(other);
  for (std::size_t i = 0; i < mine.size(); ++i) {
    if (!mine[i].found() || theirs[i].found()) continue;
    table.rows.push_back({one.name, std::string("object found"), run, std::int64_t{mine[i].object},
                          std::int64_t{mine[i].best_valid_rank}, Cell(), Cell(), Cell()});
  }
}

void add_handle_rows(const JudgedFrame& one, const JudgedFrame& other, const std::string& run, Table& table) {
  for (std::size_t rank = 0; rank < one.handles.size(); ++rank) {
    const JudgedHandle& handle = one.handles[rank];
    if (!handle.valid || is_matched(handle, other)) continue;
    const Eigen::Vector3f& p = handle.handle.position;
    table.rows.push_back({one.name, std::string("valid handle"), run, std::int64_t{handle.object},
                          static_cast<std::int64_t>(rank), double{p.x()}, double{p.y()}, double{p.z()}});
  }
}

}  // namespace

Table difference_table(const NamedRun& a, const NamedRun& b) {
  Table table{"differences",
              "What one of both has alone",
              {"frame", "what", "only in", "object", "rank", "px", "py", "pz"},
              {}};
  for (std::size_t i = 0; i < std::min(a.frames.size(), b.frames.size()); ++i) {
    add_object_rows(a.frames[i], b.frames[i], a.name, table);
    add_object_rows(b.frames[i], a.frames[i], b.name, table);
    add_handle_rows(a.frames[i], b.frames[i], a.name, table);
    add_handle_rows(b.frames[i], a.frames[i], b.name, table);
  }
  return table;
}

}  // namespace graspd
