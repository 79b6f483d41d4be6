// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/handle_score.hpp"

#include <algorithm>

namespace graspd {
namespace {

/// How often a contact of this kind is what it seems.
float reliability(ContactKind kind) {
  switch (kind) {
    case ContactKind::kWall:
      return 1.0f;
    case ContactKind::kFreeEdge:
      return 0.97f;
    case ContactKind::kCurvedEdge:
      return 0.95f;
    case ContactKind::kFlatEdge:
      return 0.90f;
    case ContactKind::kThin:
      return 0.95f;
    case ContactKind::kNone:
      return 0.0f;
  }
  return 0.0f;
}

float term(float margin, float weight) {
  return 1 - weight * (1 - std::clamp(margin, 0.0f, 1.0f));
}

}  // namespace

float score(const HandleMargins& m) {
  return reliability(m.contact[0]) * reliability(m.contact[1]) * term(m.width, 0.15f) *
         term(m.grip_depth, 0.15f) * term(m.silhouettes, 0.10f) * term(m.walls, 0.10f) *
         term(m.square, 0.10f) * term(m.seen, 0.10f) * term(m.central, 0.15f);
}

}  // namespace graspd
