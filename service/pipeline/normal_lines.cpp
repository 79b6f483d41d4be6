// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/normal_lines.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace graspd {

std::optional<Eigen::Vector2f> meeting_point(std::span<const NormalLine> lines, float scale_m) {
  constexpr int kRounds = 4;
  constexpr float kMinSpread = 0.06f;  // of the normals, as a variance
  Eigen::Vector2f center = Eigen::Vector2f::Zero();
  for (const NormalLine& line : lines) center += line.p / static_cast<float>(lines.size());
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix2f A = Eigen::Matrix2f::Zero();
    Eigen::Vector2f b = Eigen::Vector2f::Zero();
    float sum = 0;
    for (const NormalLine& line : lines) {
      const Eigen::Vector2f t(-line.normal.y(), line.normal.x());
      const float away = line.passes(center), error = away / scale_m;
      const float u = round == 0 ? 1 : 1 / (1 + error * error);
      A += u * t * t.transpose();
      b += u * away * t;
      sum += u;
    }
    const float mean = 0.5f * A.trace(),
                spread = mean - std::sqrt(std::max(0.0f, mean * mean - A.determinant()));
    if (!(spread > kMinSpread * sum)) return std::nullopt;
    center += A.inverse() * b;
  }
  return center;
}

}  // namespace graspd
