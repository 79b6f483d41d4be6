// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A whole file as bytes.
#pragma once
#include <filesystem>
#include <string>

namespace graspd {

/// Throws std::runtime_error, `path: reason`, for what cannot be read to its end, and for a folder.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

}  // namespace graspd
