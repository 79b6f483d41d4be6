// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Depth images in types of others; the first byte chooses the type.
#include "service/transport/wire_layout.hpp"
#include "tests/fuzz/cloud_fuzzer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kLargestRatio = 1032;  // of deflate
  if (size == 0) return 0;
  graspd::DecodeLimits limits;
  limits.max_points = 100'000;
  const graspd::CloudInput input{{0, 0, 0}, {500, 500, 320, 240}};
  const auto type = data[0] % 2 == 0 ? graspd::kImagesFingerprint : graspd::kLcmtImageArrayFingerprint;
  graspd::check_cloud(graspd::message_of(type, data + 1, size - 1), limits, input, kLargestRatio);
  return 0;
}
