// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What the kernel says in a file.
#pragma once
#include <fstream>
#include <iterator>
#include <string>

namespace graspd {

/// Of a small file; empty where it cannot be read.
[[nodiscard]] inline std::string file_text(const char* path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace graspd
