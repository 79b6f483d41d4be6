// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <filesystem>
#include <functional>
#include <string>

namespace graspd {

/// The text of the ConfigError that the call throws, without "FILE: " in front; empty when it throws none.
[[nodiscard]] std::string config_error(const std::filesystem::path& file, const std::function<void()>& call);

}  // namespace graspd
