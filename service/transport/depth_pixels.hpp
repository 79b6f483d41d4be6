// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Depth images as others pack them: 16-bit millimetres or 32-bit metres, either byte order, compressed or
// not.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "service/transport/cloud_input.hpp"
#include "service/transport/frame.hpp"
#include "service/transport/refusal.hpp"

namespace graspd {

/// The members of a message as they came, unchecked; a view into its bytes.
struct DepthPixels {
  enum class Format : std::uint8_t { kMillimetres16, kMetres32 };
  enum class Packing : std::uint8_t { kNone, kZlib, kPng };

  std::int64_t width = 0;
  std::int64_t height = 0;
  std::int64_t row_stride = 0;  ///< [bytes], of what is not compressed or behind zlib
  Format format = Format::kMillimetres16;
  Packing packing = Packing::kNone;
  bool big_endian = false;  ///< of PNG it says nothing
  bool saturates = false;   ///< 65535 mm stands for too far
  std::span<const std::byte> data;
};

/// The sizes hold together and with the data, as far as that can be told of compressed data.
[[nodiscard]] std::optional<Refusal> check_depth_pixels(std::string_view type, const DepthPixels& pixels,
                                                        const FrameHeader& header,
                                                        const DecodeLimits& limits);

/// An organized cloud in the optical frame of pixels that have passed the check. Depths of 0, negative or not
/// finite are none: NaN.
[[nodiscard]] std::variant<Frame, Refusal> decode_depth_pixels(std::string_view type,
                                                               const DepthPixels& pixels, FrameHeader header,
                                                               const CloudInput& input);

}  // namespace graspd
