// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Clouds in types of others; the first byte chooses the type.
#include <array>

#include "service/transport/wire_layout.hpp"
#include "tests/fuzz/cloud_fuzzer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::array kTypes{graspd::kLcmtPointCloudFingerprint, graspd::kPointcloud2Fingerprint,
                              graspd::kPointcloudFingerprint, graspd::kSensorMsgsPointCloud2Fingerprint};
  if (size == 0) return 0;
  graspd::check_cloud(graspd::message_of(kTypes[data[0] % kTypes.size()], data + 1, size - 1));
  return 0;
}
