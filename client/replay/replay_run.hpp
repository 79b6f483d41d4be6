// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A replay from its configuration to its receipt, with what people see of it.
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "client/replay/replay.hpp"

namespace graspd {

/// Nothing when it was stopped. Shows the progress, and a summary at the end.
[[nodiscard]] std::optional<Receipt> replay_to(const CLI::App& app, const ReplayConfig& config,
                                               const std::filesystem::path& output, OldOutput old);

/// "OK 40, NO_HANDLES 2".
[[nodiscard]] std::string answers_text(const ReplayState& state);

}  // namespace graspd
