// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The shards' outputs as one, and nothing else: every frame once, every byte as it was written.
#pragma once
#include <cstddef>
#include <filesystem>
#include <vector>

#include "client/replay/plan.hpp"
#include "client/replay/replay_output.hpp"

namespace graspd {

/// Shards whose output is not there or not this plan's; the files' contents are not looked at.
[[nodiscard]] std::vector<std::size_t> missing_shards(const std::filesystem::path& folder, const Plan& plan);

/// Checks every shard's output against its receipt (bytes, SHA-256) and against the plan (frames), and writes
/// what a run over all logs would have written. Throws std::runtime_error for the first shard that is not as
/// it must be; then there is no output.
Receipt merge_shards(const std::filesystem::path& folder, const Plan& plan,
                     const std::filesystem::path& output, OldOutput old);

}  // namespace graspd
