// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A YAML file as a tree, after the checks that the parser leaves out.
#pragma once
#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "service/config/config_error.hpp"

namespace graspd {

inline constexpr std::size_t kMaxConfigBytes = std::size_t{1} << 20;
inline constexpr std::size_t kMaxConfigNodes = 20'000;  ///< values, lists and maps; an alias counts once
inline constexpr std::size_t kMaxConfigDepth = 32;      ///< lists and maps inside each other

/// The file's only document; null for an empty one. Throws ConfigError when it cannot be read, is beyond
/// the limits above, is not UTF-8 text, or is not YAML.
[[nodiscard]] YAML::Node load_yaml(const std::filesystem::path& file);

/// The same for text that did not come from a file; `place` is named in errors.
[[nodiscard]] YAML::Node parse_yaml(const std::string& text, const ConfigPlace& place);

/// Whether all of it is valid UTF-8 and holds no NUL.
[[nodiscard]] bool is_utf8_text(std::string_view text);

}  // namespace graspd
