// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/wire_layout.hpp"
#include "tests/fuzz/cloud_fuzzer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graspd::check_cloud(graspd::message_of(graspd::kPointCloudFingerprint, data, size));
  return 0;
}
