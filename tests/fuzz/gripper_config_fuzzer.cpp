// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/service_config.hpp"
#include "tests/fuzz/config_fuzzer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graspd::check_config(data, size,
                       [](const auto& file) { graspd::require(!graspd::load_gripper(file).validate()); });
  return 0;
}
