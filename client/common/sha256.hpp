// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Checksums that sha256sum(1) gives too.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace graspd {

/// 64 hexadecimal digits.
[[nodiscard]] std::string sha256_of(std::string_view text);

/// Of a file's bytes, read a piece at a time. Throws std::runtime_error that names the file.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace graspd
