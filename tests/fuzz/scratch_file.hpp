// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Fuzzed bytes as a file, for readers that take a path: in memory, and gone with the process.
#pragma once
#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/fuzz/fuzzer.hpp"

namespace graspd {

/// The path of a regular file with these bytes, until the next call.
inline std::filesystem::path scratch_file(const std::uint8_t* data, std::size_t size) {
  static const int fd = memfd_create("fuzzed", MFD_CLOEXEC);
  require(fd >= 0 && ftruncate(fd, 0) == 0 && pwrite(fd, data, size, 0) == static_cast<ssize_t>(size));
  return "/proc/self/fd/" + std::to_string(fd);
}

}  // namespace graspd
