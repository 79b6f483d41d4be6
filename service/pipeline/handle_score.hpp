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
  float grip = 1;         ///< how far both walls are from leaning so much that the jaws squeeze it out
  float walls = 1;        ///< how little they widen towards the fingertips
  float seen = 1;         ///< smaller of the two fingers' observed free shares
  float thickness = 1;    ///< how far the object is from so narrow that its normals mix both of its sides
  float area = 1;         ///< how much of it is seen between the jaws
  float one_face = 1;     ///< how surely what looks back between the jaws is one thing's
  float steady = 1;       ///< share of the poses next to it that hold too
  float central = 1;      ///< how near the jaws are to the middle of the visible object

  [[nodiscard]] bool has_thin_edge() const {
    return contact[0] == ContactKind::kThinEdge || contact[1] == ContactKind::kThinEdge;
  }
};

/// The chance that the handle holds: a logistic function of the contacts and the margins, each of which takes
/// from the log odds of the best handle there can be. The weights come from a logistic regression over
/// handles on simulated scenes, for two sensors and several apertures, that were judged on their true solids
/// (graspd-evaluate --simulate); no real frame took part. Those of thin edges and of the grip
/// were set by hand; all were then scaled, and the best log odds set, so that scores are as the shares of
/// valid handles.
[[nodiscard]] float score(const HandleMargins& margins);

}  // namespace graspd
