// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/seal_keys.hpp"

#include <stdexcept>

#include "tests/fuzz/fuzzer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto keys = graspd::parse_seal_keys({reinterpret_cast<const char*>(data), size});
    graspd::require(!keys.empty() && keys.size() <= 16 && size >= 64);
  } catch (const std::runtime_error&) {
  }
  return 0;
}
