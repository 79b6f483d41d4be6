// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/foreign_image_decoder.hpp"

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "service/transport/decoding.hpp"
#include "service/transport/depth_pixels.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

constexpr std::int32_t kMaxBytes = std::numeric_limits<std::int32_t>::max();
constexpr std::int32_t kMaxImages = 64;
constexpr std::int32_t kMaxMetadata = 1024;

/// A message's depth image, where it has one.
struct ForeignImage {
  FrameHeader header;
  bool found = false;
  std::string problem;  ///< why its pixels cannot be read; empty: nothing
  DepthPixels pixels;
};

constexpr std::size_t kMinMetadataBytes = 4 + 1 + 4;
constexpr std::size_t kMinBotCoreImageBytes = 2 + 8 + 5 * 4 + 4;
constexpr std::int16_t kDepthMm = 4;
constexpr std::int16_t kDepthMmZipped = 6;

FrameHeader read_images_header(ByteReader& reader, const DecodeLimits&) {
  FrameHeader header;
  header.utime = reader.int64("utime");
  return header;
}

/// Numbers are little-endian, whatever pixelformat says: so are those of all publishers.
DepthPixels read_bot_core_image(ByteReader& reader, const DecodeLimits& limits) {
  DepthPixels pixels;
  (void)reader.int64("images.utime");
  pixels.width = reader.int32("images.width");
  pixels.height = reader.int32("images.height");
  pixels.row_stride = reader.int32("images.row_stride");
  (void)reader.int32("images.pixelformat");
  pixels.data =
      reader.bytes("images.data", static_cast<std::size_t>(reader.count("images.size", kMaxBytes, 1)));
  const std::int32_t entries = reader.count("images.nmetadata", kMaxMetadata, kMinMetadataBytes);
  for (std::int32_t i = 0; i < entries && reader.ok(); ++i) {
    (void)reader.string("images.metadata.key", limits.max_name_length);
    reader.skip("images.metadata.value",
                static_cast<std::size_t>(reader.count("images.metadata.n", kMaxBytes, 1)));
  }
  return pixels;
}

ForeignImage read_images(ByteReader& reader, const DecodeLimits& limits) {
  ForeignImage image;
  image.header = read_images_header(reader, limits);
  std::pmr::vector<std::int16_t> types(
      static_cast<std::size_t>(reader.count("n_images", kMaxImages, kMinBotCoreImageBytes)));
  for (std::int16_t& type : types) type = reader.int16("image_types");
  for (const std::int16_t type : types) {
    DepthPixels pixels = read_bot_core_image(reader, limits);
    if (image.found || (type != kDepthMm && type != kDepthMmZipped)) continue;
    image.found = true;
    image.pixels = pixels;
    image.pixels.packing = type == kDepthMmZipped ? DepthPixels::Packing::kZlib : DepthPixels::Packing::kNone;
  }
  return image;
}

constexpr std::size_t kMinDrakeImageBytes = 4 + 8 + 4 + 1 + 4 * 4 + 4;
constexpr std::int8_t kPixelFormatDepth = 5;
constexpr std::int8_t kChannelUint16 = 3;
constexpr std::int8_t kChannelFloat32 = 6;

FrameHeader read_drake_header(ByteReader& reader, const DecodeLimits& limits) {
  FrameHeader header;
  const std::int32_t seq = reader.int32("header.seq");
  if (reader.ok()) header.seq = seq;
  header.utime = reader.int64("header.utime");
  header.frame_name = reader.text("header.frame_name", limits.max_name_length);
  return header;
}

/// How its pixels are packed; what is wrong, or nothing.
std::string set_drake_format(std::int8_t channel_type, std::int8_t compression, DepthPixels& pixels) {
  const bool is_uint16 = channel_type == kChannelUint16;
  if (!is_uint16 && channel_type != kChannelFloat32)
    return "no channel_type of depth (got " + std::to_string(channel_type) +
           ", expected 3, UINT16, or 6, FLOAT32)";
  pixels.format = is_uint16 ? DepthPixels::Format::kMillimetres16 : DepthPixels::Format::kMetres32;
  pixels.saturates = is_uint16;
  switch (compression) {
    case 0:
      pixels.packing = DepthPixels::Packing::kNone;
      return {};
    case 1:
      pixels.packing = DepthPixels::Packing::kZlib;
      return {};
    case 3:
      pixels.packing = DepthPixels::Packing::kPng;
      return is_uint16 ? "" : "PNG has no such pixels (got channel_type 6, expected 3, UINT16)";
    default:
      return "unknown compression_method (got " + std::to_string(compression) +
             ", expected 0, none, 1, zlib, or 3, PNG)";
  }
}

/// One of the array; taken over when it is the first with depth.
void read_drake_image(ByteReader& reader, const DecodeLimits& limits, ForeignImage& image) {
  DepthPixels pixels;
  const FrameHeader header = read_drake_header(reader, limits);
  pixels.width = reader.int32("images.width");
  pixels.height = reader.int32("images.height");
  pixels.row_stride = reader.int32("images.row_stride");
  pixels.data =
      reader.bytes("images.data", static_cast<std::size_t>(reader.count("images.size", kMaxBytes, 1)));
  pixels.big_endian = reader.int8("images.bigendian") != 0;
  const std::int8_t pixel_format = reader.int8("images.pixel_format");
  const std::int8_t channel_type = reader.int8("images.channel_type");
  const std::int8_t compression = reader.int8("images.compression_method");
  if (!reader.ok() || image.found || pixel_format != kPixelFormatDepth) return;
  image.found = true;
  image.problem = set_drake_format(channel_type, compression, pixels);
  image.pixels = pixels;
  if (image.header.frame_name.empty()) image.header.frame_name = header.frame_name;
}

ForeignImage read_image_array(ByteReader& reader, const DecodeLimits& limits) {
  ForeignImage image;
  image.header = read_drake_header(reader, limits);
  const std::int32_t count = reader.count("num_images", kMaxImages, kMinDrakeImageBytes);
  for (std::int32_t i = 0; i < count && reader.ok(); ++i) read_drake_image(reader, limits, image);
  return image;
}

FrameHeader read_image_array_header(ByteReader& reader, const DecodeLimits& limits) {
  return read_image_array(reader, limits).header;
}

struct Images {
  static constexpr std::uint64_t kFingerprint = kImagesFingerprint;
  static constexpr const char* kName = "images_t";
  static constexpr const char* kKindMember = "image_types";
  static constexpr const char* kMissing = "no depth image (expected DEPTH_MM, 4, or DEPTH_MM_ZIPPED, 6)";
  static constexpr auto kReadHeader = read_images_header;
  static constexpr auto kRead = read_images;
};
struct LcmtImageArray {
  static constexpr std::uint64_t kFingerprint = kLcmtImageArrayFingerprint;
  static constexpr const char* kName = "lcmt_image_array";
  static constexpr const char* kKindMember = "images.pixel_format";
  static constexpr const char* kMissing = "no depth image (expected one with 5, DEPTH)";
  static constexpr auto kReadHeader = read_image_array_header;
  static constexpr auto kRead = read_image_array;
};

template <class Type>
std::variant<ForeignImage, Refusal> parse(std::span<const std::byte> message, const DecodeLimits& limits,
                                          const CloudInput& input) {
  const std::string type = Type::kName;
  ByteReader reader(message);
  reader.skip("fingerprint", kFingerprintBytes);
  ForeignImage image = Type::kRead(reader, limits);
  reader.finish();
  if (!reader.ok()) return refuse(reader, type, image.header);
  if (!image.found)
    return refuse(RefusalReason::kMissingField, type + "." + Type::kKindMember, Type::kMissing, image.header);
  if (!image.problem.empty())
    return refuse(RefusalReason::kBadField, type + ".images", image.problem, image.header);
  if (auto refusal = check_depth_pixels(type, image.pixels, image.header, limits)) return *std::move(refusal);
  if (!input.camera.given())
    return refuse(
        RefusalReason::kBadCalibration, type,
        "carries no intrinsics (expected them in the configuration: input.camera of the source, fx_px, "
        "fy_px, cx_px and cy_px)",
        image.header);
  return image;
}

template <class Type>
CloudType image_type() {
  CloudType type{Type::kFingerprint, Type::kName, Type::kReadHeader, nullptr, nullptr};
  type.check = [](std::span<const std::byte> message, const DecodeLimits& limits,
                  const CloudInput& input) -> std::optional<Refusal> {
    auto parsed = parse<Type>(message, limits, input);
    if (auto* refusal = std::get_if<Refusal>(&parsed)) return std::move(*refusal);
    return std::nullopt;
  };
  type.decode = [](std::span<const std::byte> message, const DecodeLimits& limits,
                   const CloudInput& input) -> std::variant<Frame, Refusal> {
    auto parsed = parse<Type>(message, limits, input);
    if (auto* refusal = std::get_if<Refusal>(&parsed)) return std::move(*refusal);
    ForeignImage& image = std::get<ForeignImage>(parsed);
    return decode_depth_pixels(Type::kName, image.pixels, std::move(image.header), input);
  };
  return type;
}

}  // namespace

CloudType images_type() {
  return image_type<Images>();
}
CloudType lcmt_image_array_type() {
  return image_type<LcmtImageArray>();
}

}  // namespace graspd
