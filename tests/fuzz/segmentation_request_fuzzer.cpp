// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/segmentation_request_codec.hpp"
#include "service/transport/wire_layout.hpp"
#include "tests/fuzz/fuzzer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto message = graspd::message_of(graspd::kSegmentationRequestFingerprint, data, size);
  const auto decoded = graspd::decode_segmentation_request(message);
  if (decoded) graspd::require(graspd::encode(*decoded) == message);  // every byte was understood
  return 0;
}
