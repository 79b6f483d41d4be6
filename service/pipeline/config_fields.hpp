// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// How configuration structs describe their fields: once, for reading, printing, range checks and
// documentation.
#pragma once
#include <limits>
#include <optional>
#include <string>

namespace graspd {

/// Both ends belong to the range.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// A rule between several fields that does not hold: the field to change, and why.
struct ConfigProblem {
  std::string key;
  std::string reason;
};

// A configuration struct has
//   template <class Self, class Visitor> static void visit(Self& self, Visitor&& v)
// that calls, once a field and in the order of the file, for a value
//   v("leaf_size_m", self.leaf_size_m, Range{0, 0.1}, "edge of a voxel [m]; 0 keeps every point");
// and for a nested struct
//   v("downsample", self.downsample, "one point a voxel");
// and, where fields depend on each other,
//   std::optional<ConfigProblem> validate() const;
// Self is const for printing. Field types: bool, int, float, double, std::string, std::vector of those,
// Eigen::Vector3f.

}  // namespace graspd
