// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Orders handles best first and keeps one for each distinct place.
#pragma once
#include <functional>
#include <memory_resource>
#include <vector>

#include "service/pipeline/config_fields.hpp"
#include "service/pipeline/handle.hpp"

namespace graspd {

struct HandleRankingConfig {
  int max_handles = 100;
  int max_per_object = 3;
  float min_score = 0.42f;
  float min_further_score = 0.905f;
  float distinct_distance_m = 0.02f;
  float distinct_angle_deg = 30.0f;
  float spread_m = 0.05f;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("max_handles", self.max_handles, Range{1, 10000}, "a list has at most this many handles");
    v("max_per_object", self.max_per_object, Range{1, 1000}, "and this many for one object");
    v("min_score", self.min_score, Range{0, 1}, "handles below it are left out");
    v("min_further_score", self.min_further_score, Range{0, 1},
      "the same for all but the best handle of an object");
    v("distinct_distance_m", self.distinct_distance_m, Range{0, 1}, "handles this close are one place [m]");
    v("distinct_angle_deg", self.distinct_angle_deg, Range{0, 180},
      "when their orientations differ by less than this [degrees]");
    v("spread_m", self.spread_m, Range{0.001, 1},
      "of two further handles for an object the one this far from the others is worth more [m]");
  }
};

/// A handle and the object that it holds.
struct RankedHandle {
  Handle handle;
  int object = -1;
  bool is_first = false;  ///< of its object, whatever the others score; its score is final
  float central = 1;      ///< HandleMargins::central
};

/// Sets the final scores of the handles with these indices; each is asked for once.
using SettleScores =
    std::function<void(const std::pmr::vector<std::size_t>& which, std::pmr::vector<RankedHandle>& handles)>;

/// One for each distinct place, max_per_object for each object: its first, which is its best where none is
/// marked, and then those that score best with regard to how far they are from the ones before and from the
/// object's middle. What the others score beyond the first is noise: they get its score. Best score first;
/// ties keep the order of the input, but for the first ones, which come before others. settle: scores are
/// upper bounds, and it is asked for the final ones of those handles that the result depends on; without,
/// they are final.
[[nodiscard]] std::pmr::vector<Handle> rank_handles(std::pmr::vector<RankedHandle> handles,
                                                    const HandleRankingConfig& config,
                                                    const SettleScores& settle = {});

}  // namespace graspd
