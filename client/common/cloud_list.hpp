// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Files and folders on a command line -> the cloud files that are meant, in order.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace graspd {

/// As people sort: runs of digits by their value, so that learn2 comes before learn10.
[[nodiscard]] bool natural_less(std::string_view a, std::string_view b);

/// Files stay as given; a folder stands for the cloud files in it, sorted naturally. Throws CloudFileError
/// for what does not exist and for folders without cloud files.
[[nodiscard]] std::vector<std::filesystem::path> list_cloud_files(const std::vector<std::string>& arguments);

}  // namespace graspd
