// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/compressed_image.hpp"

#include <spng.h>
#include <zlib.h>

#include <bit>
#include <memory>

namespace graspd {
namespace {

static_assert(std::endian::native == std::endian::little, "libspng gives numbers in the machine's order");

constexpr std::size_t kMaxChunkBytes = 1 << 20;  // of what is not pixels: text, profiles
constexpr std::uint8_t kGray16[2] = {SPNG_COLOR_TYPE_GRAYSCALE, 16};

std::string size_text(std::size_t width, std::size_t height) {
  return std::to_string(width) + " * " + std::to_string(height);
}

}  // namespace

std::size_t most_inflated(std::size_t compressed_bytes) {
  constexpr std::size_t kLargestRatio = 1032;  // of deflate
  return compressed_bytes * kLargestRatio;
}

std::string inflate(std::span<const std::byte> zlib, std::span<std::byte> out) {
  uLongf size = out.size();
  const int code = uncompress(reinterpret_cast<Bytef*>(out.data()), &size,
                              reinterpret_cast<const Bytef*>(zlib.data()), zlib.size());
  if (code == Z_BUF_ERROR)
    return "not as long as the image (expected " + std::to_string(out.size()) + " bytes)";
  if (code != Z_OK) return std::string("no zlib data (zlib says ") + zError(code) + ")";
  if (size != out.size())
    return "not as long as the image (got " + std::to_string(size) + " bytes, expected " +
           std::to_string(out.size()) + ")";
  return {};
}

std::string read_png16(std::span<const std::byte> png, std::size_t width, std::size_t height,
                       std::span<std::byte> out) {
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> context(spng_ctx_new(0), spng_ctx_free);
  if (!context) return "out of memory";
  const auto failed = [](int code) {
    return code == 0 ? std::string()
                     : std::string("no PNG that can be read (libspng says ") + spng_strerror(code) + ")";
  };
  spng_set_image_limits(context.get(), static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
  spng_set_chunk_limits(context.get(), kMaxChunkBytes, kMaxChunkBytes);
  int code = spng_set_png_buffer(context.get(), png.data(), png.size());
  spng_ihdr header{};
  if (code == 0) code = spng_get_ihdr(context.get(), &header);
  if (code != 0) return failed(code);
  if (header.width != width || header.height != height)
    return "a PNG of another size (got " + size_text(header.width, header.height) + ", expected " +
           size_text(width, height) + ")";
  if (header.color_type != kGray16[0] || header.bit_depth != kGray16[1])
    return "not one channel of 16 bits (got colour type " + std::to_string(header.color_type) + " of " +
           std::to_string(header.bit_depth) + " bits)";
  return failed(spng_decode_image(context.get(), out.data(), out.size(), SPNG_FMT_PNG, 0));
}

}  // namespace graspd
