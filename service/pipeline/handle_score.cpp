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
      return 0.6f;
    case ContactKind::kCurvedEdge:
      return 0.1f;
    case ContactKind::kFlatEdge:
      return 0.3f;
    case ContactKind::kThinEdge:
      return 2.0f;
    case ContactKind::kNone:
      return 10.0f;
  }
  return 10.0f;
}

/// And by a margin that is used up.
float doubt(float margin, float weight) {
  return weight * (1 - std::clamp(margin, 0.0f, 1.0f));
}

}  // namespace

float score(const HandleMargins& m) {
  constexpr float kBestLogOdds = 5.0f;
  const float doubts = doubt(m.contact[0]) + doubt(m.contact[1]) + doubt(m.square, 3.4f) +
                       doubt(m.area, 2.2f) + doubt(m.walls, 3.4f) + doubt(m.grip, 2.5f) +
                       doubt(m.seen, 1.6f) + doubt(m.thickness, 1.3f) + doubt(m.silhouettes, 2.3f) +
                       doubt(m.grip_depth, 0.1f) + doubt(m.central, 0.2f) + doubt(m.width, 0.1f) +
                       doubt(m.one_face, 3.0f) + doubt(m.steady, 2.0f);
  return 1 / (1 + std::exp(doubts - kBestLogOdds));
}

}  // namespace graspd
