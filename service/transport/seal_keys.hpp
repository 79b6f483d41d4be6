// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Files of keys: 64 hexadecimal digits a line, # begins a comment.
#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "service/transport/seal.hpp"

namespace graspd {

/// The keys of a file, the one to sign with first. Throws std::runtime_error with one line that names the
/// file: when it cannot be read, others than its owner and group may read it or any but its owner write it,
/// when it holds anything but keys, or none, or more than 16.
[[nodiscard]] std::vector<SealKey> load_seal_keys(const std::filesystem::path& file);

/// Of a file's text; what() of std::runtime_error names the line.
[[nodiscard]] std::vector<SealKey> parse_seal_keys(std::string_view text);

/// Writes a new random key into a new file that only its owner can read. Throws std::runtime_error, also when
/// the file is there already.
void create_seal_key(const std::filesystem::path& file);

}  // namespace graspd
