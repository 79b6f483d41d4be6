// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Files that are read by others while they are written.
#pragma once
#include <filesystem>
#include <string_view>

namespace graspd {

/// Whoever opens the file finds all of the old text or all of the new. Throws std::runtime_error that names
/// the file, and leaves the old one, when it cannot be written.
void replace_file(const std::filesystem::path& file, std::string_view text);

}  // namespace graspd
