// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What must hold of whatever a cloud decoder makes of any bytes.
#pragma once
#include <algorithm>

#include "service/transport/cloud_decoder.hpp"
#include "tests/fuzz/fuzzer.hpp"

namespace graspd {

inline bool printable_line(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

/// A frame is no larger than its message - or, where pixels are compressed, than the limits allow -, a
/// refusal says why, and both carry the header that a peek sees.
inline void check_cloud(std::span<const std::byte> message, const DecodeLimits& limits = {},
                        const CloudInput& input = {}, std::size_t compression = 1) {
  const FrameHeader header = peek_header(message, limits);
  const auto result = decode_cloud(message, limits, input);
  if (const auto* refusal = std::get_if<Refusal>(&result)) {
    require(printable_line(refusal->text) && refusal->utime == header.utime && refusal->seq == header.seq &&
            refusal->frame_name == header.frame_name);
    return;
  }
  const auto& frame = std::get<Frame>(result);
  const PointCloud& cloud = frame.cloud;
  require(cloud.size() == static_cast<std::size_t>(cloud.width) * static_cast<std::size_t>(cloud.height));
  require(cloud.y.size() == cloud.size() && cloud.z.size() == cloud.size() &&
          cloud.size() * 2 <= message.size() * compression);
  require(cloud.size() <= static_cast<std::size_t>(limits.max_points));
  require(cloud.viewpoint.allFinite());
  require(frame.utime == header.utime && frame.seq == header.seq && frame.frame_name == header.frame_name);
}

}  // namespace graspd
