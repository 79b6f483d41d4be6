// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/depth_pixels.hpp"

#include <bit>
#include <cstring>
#include <limits>
#include <memory_resource>
#include <string>
#include <utility>
#include <vector>

#include "service/transport/compressed_image.hpp"
#include "service/transport/decoding.hpp"
#include "service/transport/unproject.hpp"

namespace graspd {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
constexpr float kMetresPerMillimetre = 0.001f;
constexpr std::uint16_t kTooFar = 65535;

std::int64_t pixel_bytes(const DepthPixels& pixels) {
  return pixels.format == DepthPixels::Format::kMillimetres16 ? 2 : 4;
}

std::string got_expected(std::int64_t got, std::int64_t least, std::int64_t most) {
  return " (got " + std::to_string(got) + ", expected " + std::to_string(least) + " to " +
         std::to_string(most) + ")";
}

std::optional<Refusal> check_data(std::string_view type, const DepthPixels& p, const FrameHeader& header) {
  const auto size = static_cast<std::int64_t>(p.data.size());
  const std::int64_t row = p.width * pixel_bytes(p);
  const std::int64_t whole =
      p.packing == DepthPixels::Packing::kPng ? row * p.height : p.row_stride * p.height;
  if (p.packing != DepthPixels::Packing::kNone) {
    if (whole <= static_cast<std::int64_t>(most_inflated(p.data.size()))) return std::nullopt;
    return refuse(RefusalReason::kBadSize, std::string(type) + ".images.size",
                  "too few bytes for the image (got " + std::to_string(size) + ", expected " +
                      std::to_string(whole) + " bytes compressed)",
                  header);
  }
  const std::int64_t least = whole - p.row_stride + row;  // the last row may end with its last pixel
  if (size >= least && size <= whole) return std::nullopt;
  return refuse(RefusalReason::kBadSize, std::string(type) + ".images.size",
                "contradicts the other sizes" + got_expected(size, least, whole), header);
}

/// The bytes of compressed pixels; what is wrong, or nothing.
std::string decompress(const DepthPixels& p, std::pmr::vector<std::byte>& bytes) {
  const auto width = static_cast<std::size_t>(p.width);
  const auto height = static_cast<std::size_t>(p.height);
  if (p.packing == DepthPixels::Packing::kPng) {
    bytes.resize(width * height * sizeof(std::uint16_t));
    return read_png16(p.data, width, height, bytes);
  }
  bytes.resize(static_cast<std::size_t>(p.row_stride) * height);
  return inflate(p.data, bytes);
}

float metres_of_16(const std::byte* row, std::size_t u, bool big_endian, bool saturates) {
  std::uint16_t depth = 0;
  std::memcpy(&depth, row + u * sizeof(depth), sizeof(depth));
  if (big_endian) depth = __builtin_bswap16(depth);
  const bool none = depth == 0 || (saturates && depth == kTooFar);
  return none ? kMissing : static_cast<float>(depth) * kMetresPerMillimetre;
}

float metres_of_32(const std::byte* row, std::size_t u, bool big_endian) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, row + u * sizeof(bits), sizeof(bits));
  if (big_endian) bits = __builtin_bswap32(bits);
  const auto depth = std::bit_cast<float>(bits);
  const bool some = depth > 0 && depth <= std::numeric_limits<float>::max();  // false for NaN
  return some ? depth : kMissing;
}

void unproject_pixels(const DepthPixels& p, const CameraIntrinsics& camera, PointCloud& cloud) {
  const auto stride = static_cast<std::size_t>(p.row_stride);
  if (p.format == DepthPixels::Format::kMillimetres16) {
    unproject(
        p.data, stride, camera,
        [&](const std::byte* row, std::size_t u) { return metres_of_16(row, u, p.big_endian, p.saturates); },
        cloud);
  } else {
    unproject(
        p.data, stride, camera,
        [&](const std::byte* row, std::size_t u) { return metres_of_32(row, u, p.big_endian); }, cloud);
  }
}

}  // namespace

std::optional<Refusal> check_depth_pixels(std::string_view type, const DepthPixels& pixels,
                                          const FrameHeader& header, const DecodeLimits& limits) {
  const auto product = [&] { return std::to_string(pixels.width) + " * " + std::to_string(pixels.height); };
  if (pixels.width < 0 || pixels.height < 0)
    return refuse(RefusalReason::kBadSize, std::string(type) + ".images.width, height",
                  "negative (got " + product() + ", expected at least 0)", header);
  if (pixels.width == 0 || pixels.height == 0) return std::nullopt;
  if (pixels.width > limits.max_points / pixels.height)
    return refuse(
        RefusalReason::kTooLarge, std::string(type) + ".images.width * height",
        "too many pixels (got " + product() + ", expected at most " + std::to_string(limits.max_points) + ")",
        header);
  const std::int64_t row = pixels.width * pixel_bytes(pixels);
  const std::int64_t longest = 2 * row + 4096;  // more is no padding
  if (pixels.packing != DepthPixels::Packing::kPng &&
      (pixels.row_stride < row || pixels.row_stride > longest))
    return refuse(RefusalReason::kBadSize, std::string(type) + ".images.row_stride",
                  "contradicts the other sizes" + got_expected(pixels.row_stride, row, longest), header);
  return check_data(type, pixels, header);
}

std::variant<Frame, Refusal> decode_depth_pixels(std::string_view type, const DepthPixels& compressed,
                                                 FrameHeader header, const CloudInput& input) {
  DepthPixels pixels = compressed;
  std::pmr::vector<std::byte> bytes;
  const bool has_pixels = pixels.width > 0 && pixels.height > 0;
  if (has_pixels && pixels.packing != DepthPixels::Packing::kNone) {
    if (const std::string problem = decompress(pixels, bytes); !problem.empty())
      return refuse(RefusalReason::kBadCompression, std::string(type) + ".images.data", problem, header);
    pixels.data = bytes;
    if (pixels.packing == DepthPixels::Packing::kPng) {
      pixels.row_stride = pixels.width * pixel_bytes(pixels);
      pixels.big_endian = false;
    }
  }
  Frame frame{header.utime, header.seq, std::move(header.frame_name), {}};
  frame.cloud.width = static_cast<int>(pixels.width);
  frame.cloud.height = static_cast<int>(pixels.height);
  frame.cloud.resize(static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height));
  if (has_pixels) unproject_pixels(pixels, input.camera, frame.cloud);
  return frame;
}

}  // namespace graspd
