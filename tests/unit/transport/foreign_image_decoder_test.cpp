// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/foreign_image_decoder.hpp"

#include <gtest/gtest.h>
#include <spng.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "bot_core/images_t.hpp"
#include "drake/lcmt_image_array.hpp"
#include "service/transport/cloud_decoder.hpp"
#include "tests/unit/transport/allocations.hpp"
#include "tests/unit/transport/message_samples.hpp"

namespace graspd {
namespace {

using Data = std::vector<std::uint8_t>;

const CloudInput kCamera{{0, 0, 0}, {500, 510, 1.5, 0.5}};
constexpr int kWidth = 4;
constexpr int kHeight = 2;
constexpr std::uint16_t kDepth_mm[kWidth * kHeight] = {1000, 0, 65535, 2001, 1, 700, 701, 702};

/// The pixels as they lie in memory, `padding` bytes after each row.
template <class Number>
Data pixels(const Number* numbers, bool big_endian, std::size_t padding) {
  Data data;
  for (std::size_t v = 0; v < kHeight; ++v) {
    for (std::size_t u = 0; u < kWidth; ++u) {
      Data bytes(sizeof(Number));
      std::memcpy(bytes.data(), numbers + v * kWidth + u, sizeof(Number));
      if (big_endian) std::reverse(bytes.begin(), bytes.end());
      data.insert(data.end(), bytes.begin(), bytes.end());
    }
    data.insert(data.end(), padding, 7);
  }
  return data;
}

Data zipped(const Data& data) {
  Data out(compressBound(data.size()));
  uLongf size = out.size();
  if (compress(out.data(), &size, data.data(), data.size()) != Z_OK) ADD_FAILURE();
  out.resize(size);
  return out;
}

Data png(const Data& little_endian, std::uint32_t width, std::uint32_t height, std::uint8_t bits = 16) {
  spng_ctx* context = spng_ctx_new(SPNG_CTX_ENCODER);
  spng_set_option(context, SPNG_ENCODE_TO_BUFFER, 1);
  spng_ihdr header{width, height, bits, SPNG_COLOR_TYPE_GRAYSCALE, 0, 0, 0};
  spng_set_ihdr(context, &header);
  int code = spng_encode_image(context, little_endian.data(), width * height * bits / 8, SPNG_FMT_PNG,
                               SPNG_ENCODE_FINALIZE);
  std::size_t size = 0;
  auto* buffer = static_cast<std::uint8_t*>(spng_get_png_buffer(context, &size, &code));
  EXPECT_EQ(code, 0);
  Data out(buffer, buffer + size);
  std::free(buffer);
  spng_ctx_free(context);
  return out;
}

bot_core::images_t images(const Data& data, std::int16_t type, int row_stride = 2 * kWidth) {
  bot_core::image_t colour{};
  colour.width = 1;
  colour.size = 3;
  colour.data = {1, 2, 3};
  bot_core::image_t depth{};
  depth.width = kWidth;
  depth.height = kHeight;
  depth.row_stride = row_stride;
  depth.size = static_cast<std::int32_t>(data.size());
  depth.data = data;
  depth.nmetadata = 1;
  depth.metadata = {{"key", 2, {1, 2}}};
  bot_core::images_t message{};
  message.utime = 1'000'005;
  message.n_images = 2;
  message.image_types = {0, type};
  message.images = {colour, depth};
  return message;
}

drake::lcmt_image_array image_array(const Data& data, int channel_type, int compression,
                                    int row_stride = 2 * kWidth, bool big_endian = false) {
  drake::lcmt_image colour{};
  drake::lcmt_image depth{};
  depth.header.frame_name = "depth";
  depth.width = kWidth;
  depth.height = kHeight;
  depth.row_stride = row_stride;
  depth.size = static_cast<std::int32_t>(data.size());
  depth.data = data;
  depth.bigendian = big_endian ? 1 : 0;
  depth.pixel_format = 5;
  depth.channel_type = static_cast<std::int8_t>(channel_type);
  depth.compression_method = static_cast<std::int8_t>(compression);
  drake::lcmt_image_array message{};
  message.header.seq = 3;
  message.header.utime = 1'000'006;
  message.num_images = 2;
  message.images = {colour, depth};
  return message;
}

Frame frame_of(const Bytes& message, const CloudInput& input = kCamera) {
  auto result = decode_cloud(message, {}, input);
  if (const auto* refusal = std::get_if<Refusal>(&result)) {
    ADD_FAILURE() << refusal->text;
    return {};
  }
  return std::get<Frame>(std::move(result));
}

void expect_refused(const Bytes& message, RefusalReason reason, const std::string& text,
                    const CloudInput& input = kCamera) {
  auto result = decode_cloud(message, {}, input);
  ASSERT_TRUE(std::holds_alternative<Refusal>(result));
  const auto& refusal = std::get<Refusal>(result);
  EXPECT_EQ(name(refusal.reason), name(reason));
  EXPECT_NE(refusal.text.find(text), std::string::npos) << refusal.text;
}

/// The same as depth_image_t's points, to the bit.
void expect_points(const Frame& frame, bool saturates) {
  depth_image_t own{};
  own.depth_scale = 0.001;
  own.fx = kCamera.camera.fx_px;
  own.fy = kCamera.camera.fy_px;
  own.cx = kCamera.camera.cx_px;
  own.cy = kCamera.camera.cy_px;
  own.width = kWidth;
  own.height = kHeight;
  own.data = pixels(kDepth_mm, false, 0);
  if (saturates) own.data[4] = own.data[5] = 0;
  own.data_size = static_cast<std::int32_t>(own.data.size());
  const Frame want = frame_of(raw_bytes(own));
  ASSERT_EQ(frame.cloud.size(), want.cloud.size());
  EXPECT_EQ(frame.cloud.width, kWidth);
  for (std::size_t i = 0; i < want.cloud.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint32_t>(frame.cloud.x[i]), std::bit_cast<std::uint32_t>(want.cloud.x[i]))
        << i;
    EXPECT_EQ(std::bit_cast<std::uint32_t>(frame.cloud.y[i]), std::bit_cast<std::uint32_t>(want.cloud.y[i]))
        << i;
    EXPECT_EQ(std::bit_cast<std::uint32_t>(frame.cloud.z[i]), std::bit_cast<std::uint32_t>(want.cloud.z[i]))
        << i;
  }
}

TEST(ForeignImageDecoder, BotCoreDepthIsOurDepth) {
  for (const std::size_t padding : {0u, 6u}) {
    const int stride = 2 * kWidth + static_cast<int>(padding);
    const Data data = pixels(kDepth_mm, false, padding);
    const Frame raw = frame_of(raw_bytes(images(data, 4, stride)));
    EXPECT_EQ(raw.utime, 1'000'005);
    EXPECT_EQ(raw.seq, -1);
    expect_points(raw, false);
    expect_points(frame_of(raw_bytes(images(zipped(data), 6, stride))), false);
  }
}

TEST(ForeignImageDecoder, DrakeDepthIsOurDepth) {
  for (const bool big_endian : {false, true}) {
    const Data data = pixels(kDepth_mm, big_endian, 2);
    const Frame raw = frame_of(raw_bytes(image_array(data, 3, 0, 2 * kWidth + 2, big_endian)));
    EXPECT_EQ(raw.utime, 1'000'006);
    EXPECT_EQ(raw.seq, 3);
    EXPECT_EQ(raw.frame_name, "depth");
    expect_points(raw, true);
    expect_points(frame_of(raw_bytes(image_array(zipped(data), 3, 1, 2 * kWidth + 2, big_endian))), true);
    const Data file = png(pixels(kDepth_mm, false, 0), kWidth, kHeight);
    expect_points(frame_of(raw_bytes(image_array(file, 3, 3, 0, big_endian))), true);
  }
}

TEST(ForeignImageDecoder, DrakeDepthInMetres) {
  const float metres[kWidth * kHeight] = {
      1,      0, std::numeric_limits<float>::infinity(), -1, std::numeric_limits<float>::quiet_NaN(), 0.7f,
      0.701f, 2};
  for (const bool big_endian : {false, true}) {
    const Data data = pixels(metres, big_endian, 0);
    for (const int compression : {0, 1}) {
      const Frame frame = frame_of(raw_bytes(
          image_array(compression == 1 ? zipped(data) : data, 6, compression, 4 * kWidth, big_endian)));
      for (const std::size_t none : {1u, 2u, 3u, 4u}) EXPECT_TRUE(std::isnan(frame.cloud.z[none])) << none;
      EXPECT_EQ(frame.cloud.z[5], 0.7f);
      EXPECT_EQ(frame.cloud.x[0], static_cast<float>((0 - 1.5) / 500));
      EXPECT_EQ(frame.cloud.y[7], static_cast<float>((1 - 0.5) / 510) * 2);
    }
  }
}

TEST(ForeignImageDecoder, RefusesWithoutIntrinsicsAndNamesTheRemedy) {
  const Bytes message = raw_bytes(images(pixels(kDepth_mm, false, 0), 4));
  expect_refused(message, RefusalReason::kBadCalibration, "input.camera of the source, fx_px, fy_px", {});
  const auto checked = check_cloud(message, {}, {});
  ASSERT_TRUE(checked);
  EXPECT_EQ(name(checked->reason), "bad_calibration");
}

TEST(ForeignImageDecoder, RefusesOtherImages) {
  using enum RefusalReason;
  const Data data = pixels(kDepth_mm, false, 0);
  expect_refused(raw_bytes(images(data, 2)), kMissingField, "images_t.image_types: no depth image");
  auto array = image_array(data, 3, 0);
  array.images[1].pixel_format = 8;
  expect_refused(raw_bytes(array), kMissingField, "lcmt_image_array.images.pixel_format: no depth image");
  expect_refused(raw_bytes(image_array(data, 1, 0)), kBadField, "no channel_type of depth (got 1");
  expect_refused(raw_bytes(image_array(data, 3, 2)), kBadField, "unknown compression_method (got 2");
  expect_refused(raw_bytes(image_array(data, 6, 3)), kBadField, "PNG has no such pixels");
}

TEST(ForeignImageDecoder, RefusesSizesThatContradictEachOther) {
  using enum RefusalReason;
  const Data data = pixels(kDepth_mm, false, 0);
  const auto refuses = [&](auto spoil, RefusalReason reason, const std::string& text) {
    bot_core::images_t message = images(data, 4);
    spoil(message.images[1]);
    expect_refused(raw_bytes(message), reason, text);
  };
  constexpr std::int32_t kMax32 = std::numeric_limits<std::int32_t>::max();
  refuses([](auto& i) { i.width = -4; }, kBadSize, "negative (got -4 * 2");
  refuses([](auto& i) { i.width = i.height = kMax32; }, kTooLarge, "too many pixels");
  refuses([](auto& i) { i.row_stride = 7; }, kBadSize,
          "row_stride: contradicts the other sizes (got 7, expected 8");
  refuses([](auto& i) { i.row_stride = kMax32; }, kBadSize, "row_stride");
  refuses([](auto& i) { i.height = 3; }, kBadSize, "size: contradicts the other sizes (got 16");
  refuses([](auto& i) { i.height = 1; }, kBadSize, "size: contradicts the other sizes (got 16");
}

TEST(ForeignImageDecoder, RefusesCompressedPixelsThatAreNotTheImage) {
  using enum RefusalReason;
  const Data data = pixels(kDepth_mm, false, 0);
  Data longer = data;
  longer.push_back(0);
  const Data shorter(data.begin(), data.end() - 1);
  expect_refused(raw_bytes(images(zipped(longer), 6)), kBadCompression, "not as long as the image");
  expect_refused(raw_bytes(images(zipped(shorter), 6)), kBadCompression, "not as long as the image (got 15");
  expect_refused(raw_bytes(images(data, 6)), kBadCompression, "no zlib data");
  expect_refused(raw_bytes(image_array(data, 3, 3)), kBadCompression, "no PNG that can be read");
  expect_refused(raw_bytes(image_array(png(data, kHeight, kWidth), 3, 3)), kBadCompression, "libspng says");
  expect_refused(raw_bytes(image_array(png(data, 2, 2), 3, 3)), kBadCompression, "another size (got 2 * 2");
  expect_refused(raw_bytes(image_array(png(data, kWidth, kHeight, 8), 3, 3)), kBadCompression, "16 bits");
}

TEST(ForeignImageDecoder, FewBytesAreNotInflatedToMany) {
  bot_core::images_t message = images(zipped(pixels(kDepth_mm, false, 0)), 6);
  message.images[1].width = message.images[1].height = 4000;
  message.images[1].row_stride = 8000;
  const Bytes bytes = raw_bytes(message);
  forget_allocations();
  expect_refused(bytes, RefusalReason::kBadSize, "too few bytes for the image");
  EXPECT_LT(largest_allocation(), 4096u);
}

std::vector<Bytes> small_messages() {
  const Data data = pixels(kDepth_mm, false, 0);
  return {raw_bytes(images(zipped(data), 6)), raw_bytes(image_array(data, 3, 0)),
          raw_bytes(image_array(png(data, kWidth, kHeight), 3, 3))};
}

TEST(ForeignImageDecoder, RefusesEveryTruncationAndTrailingBytes) {
  for (Bytes message : small_messages()) {
    for_each_truncation(message, [](const Bytes& part) {
      const auto result = decode_cloud(part, {}, kCamera);
      ASSERT_TRUE(std::holds_alternative<Refusal>(result)) << part.size();
      EXPECT_EQ(name(std::get<Refusal>(result).reason), name(RefusalReason::kTruncated)) << part.size();
      EXPECT_EQ(std::get<Refusal>(result).utime, peek_header(part, {}).utime);
      EXPECT_EQ(std::get<Refusal>(result).frame_name, peek_header(part, {}).frame_name);
    });
    message.push_back({});
    expect_refused(message, RefusalReason::kTrailingBytes, "goes on");
  }
}

TEST(ForeignImageDecoder, DecodesOrRefusesEveryCorruption) {
  forget_allocations();
  for (const Bytes& message : small_messages()) {
    for_each_corruption(message, [](const Bytes& corrupt) {
      const auto result = decode_cloud(corrupt, {}, kCamera);
      const auto* refusal = std::get_if<Refusal>(&result);
      if (check_cloud(corrupt, {}, kCamera)) {
        ASSERT_NE(refusal, nullptr);
      }
      if (refusal != nullptr) {
        ASSERT_FALSE(refusal->text.empty());
      }
    });
  }
  EXPECT_LT(largest_allocation(), 2'000'000u);
}

}  // namespace
}  // namespace graspd
