// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Where the files that a service file names are found.
#pragma once
#include <filesystem>
#include <string>

#include "service/config/config_error.hpp"

namespace graspd {

/// The configuration that comes with the program: ../share/graspd/config from its own folder, in a build
/// folder as in an installation.
[[nodiscard]] std::filesystem::path installed_config_folder();

/// Whether a file is meant rather than a name: it has a '/' or ends in .yaml.
[[nodiscard]] bool is_path(const std::string& name_or_path);

/// The file for a name (kind/name.yaml in `folder`, else in the installed configuration) or a path (relative
/// to `folder`). Throws ConfigError at `place` when there is none; `kind` is "grippers" or "sensors".
[[nodiscard]] std::filesystem::path find_config_file(const std::string& name_or_path, const std::string& kind,
                                                     const std::filesystem::path& folder,
                                                     const ConfigPlace& place);

}  // namespace graspd
