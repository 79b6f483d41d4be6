// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/cloud_colors.hpp"
#include "service/transport/wire_layout.hpp"
#include "tests/fuzz/fuzzer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto message = graspd::message_of(graspd::kPointCloudFingerprint, data, size);
  const auto colors = graspd::cloud_colors(message, {});
  graspd::require(colors.size() * sizeof(colors[0]) <= message.size());  // each has its bytes
  return 0;
}
