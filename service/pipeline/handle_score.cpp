// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/handle_score.hpp"

#include <algorithm>
#include <cmath>

namespace graspd {
namespace {

/// What the odds lose by a contact whose wall was not seen.
float doubt(ContactKind kind) {
  switch (kind) {
    case ContactKind::kWall:
      return 0.0f;
    case ContactKind::kFreeEdge:
      return 0.42f;
    case ContactKind::kCurvedEdge:
      return 0.07f;
    case ContactKind::kFlatEdge:
      return 0.21f;
    case ContactKind::kThinEdge:
      return 1.4f;
    case ContactKind::kNone:
      return 7.0f;
  }
  return 7.0f;
}

/// And by a margin that is used up.
float doubt(float margin, float weight) {
  return weight * (1 - std::clamp(margin, 0.0f, 1.0f));
}

}  // namespace

float score(const HandleMargins& m) {
  constexpr float kBestLogOdds = 4.4f;
  const float doubts = doubt(m.contact[0]) + doubt(m.contact[1]) + doubt(m.square, 2.4f) +
                       doubt(m.area, 1.5f) + doubt(m.walls, 2.4f) + doubt(m.grip, 1.75f) +
                       doubt(m.seen, 1.1f) + doubt(m.thickness, 0.9f) + doubt(m.silhouettes, 1.6f) +
                       doubt(m.grip_depth, 0.07f) + doubt(m.central, 0.14f) + doubt(m.width, 0.07f) +
                       doubt(m.one_face, 2.1f) + doubt(m.steady, 1.4f);
  return 1 / (1 + std::exp(doubts - kBestLogOdds));
}

}  // namespace graspd
