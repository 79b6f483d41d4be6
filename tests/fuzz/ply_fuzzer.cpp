// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/ply_reader.hpp"

#include "tests/fuzz/cloud_file_fuzzer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graspd::check_cloud_file(data, size, [](auto file) { return graspd::parse_ply(file); });
  return 0;
}
