// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Cluttered tables and bins, from a seed.
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

#include "client/simulate/scene.hpp"

namespace graspd {

enum class SceneKind { kTable, kBin, kEmpty };
[[nodiscard]] std::optional<SceneKind> scene_kind(std::string_view name);

struct SceneConfig {
  SceneKind kind = SceneKind::kTable;
  int num_objects = 8;    ///< as many of these as find a place
  double touching = 0.4;  ///< share of the objects that are pushed against others [0, 1]
  double stacked = 0.2;   ///< share that is put on top of others where that fits [0, 1]
};

/// The world's origin is the middle of the table's surface or of the bin's floor, z up. The objects come
/// last, in the order of their labels, each standing on the support or on another one, none inside another.
[[nodiscard]] Scene build_scene(const SceneConfig& config, std::uint64_t seed);

/// How many solids of a scene are objects.
[[nodiscard]] int num_objects(const Scene& scene);

}  // namespace graspd
