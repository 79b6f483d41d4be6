// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One number for how surely a handle holds: how far it is from failing each check.
#pragma once
#include <array>

#include "service/pipeline/contact.hpp"

namespace graspd {

/// How far a valid handle is from the limits of the checks, each in [0, 1] with 1 the best, and what the jaws
/// meet.
struct HandleMargins {
  std::array<ContactKind, 2> contact{ContactKind::kNone, ContactKind::kNone};  ///< at -y and +y
  float width = 1;        ///< room that the aperture leaves
  float grip_depth = 1;   ///< how deep the object reaches between the jaws
  float silhouettes = 1;  ///< how parallel the sides are to the major axis
  float square = 1;       ///< how squarely the jaws meet walls or sides
  float walls = 1;        ///< how little they widen towards the fingertips
  float seen = 1;         ///< smaller of the two fingers' observed free shares
  float central = 1;      ///< how near the jaws are to the middle of the visible object
};

/// The product of the contacts' reliabilities and of each margin's term, which goes from its weight's
/// complement to 1.
[[nodiscard]] float score(const HandleMargins& margins);

}  // namespace graspd
