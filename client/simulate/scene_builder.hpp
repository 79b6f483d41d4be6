// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Cluttered tables and bins, from a seed.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/simulate/placement.hpp"
#include "client/simulate/scene.hpp"

namespace graspd {

/// table, bin: everyday objects, loosely. easy to extreme: a test bed of growing clutter, the last one a bin
/// of touching books, bottles and boxes, some leaning or dropped on others. household: tools, fruit and other
/// things that are long, bent or put together, loosely. levels, shelf: everyday objects on a table and on a
/// block that stands on it, and on two boards between walls.
enum class SceneKind { kTable, kBin, kEmpty, kEasy, kMedium, kHard, kExtreme, kHousehold, kLevels, kShelf };
[[nodiscard]] std::optional<SceneKind> scene_kind(std::string_view name);
[[nodiscard]] std::vector<std::string> scene_kind_names();
[[nodiscard]] bool in_bin(SceneKind kind);
/// Where a camera usually looks from at such a scene, above the horizon [degrees]: into a bin more steeply.
[[nodiscard]] double usual_elevation_deg(SceneKind kind);
/// And at which height above the world's origin it looks [m].
[[nodiscard]] double usual_target_m(SceneKind kind);

struct SceneConfig {
  SceneKind kind = SceneKind::kTable;
  std::optional<int> num_objects;  ///< as many of these as find a place; without: as usual for the kind
};

/// The world's origin is the middle of the table's surface, of the bin's floor or of the lower board, z up.
/// The objects come last, in the order of their labels, each on the support or on another one, none inside
/// another.
[[nodiscard]] Scene build_scene(const SceneConfig& config, std::uint64_t seed);

}  // namespace graspd
