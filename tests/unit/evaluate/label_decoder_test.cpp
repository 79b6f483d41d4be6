// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/label_decoder.hpp"

#include <gtest/gtest.h>

#include "service/transport/cloud_encoder.hpp"
#include "tests/support/clouds.hpp"

namespace graspd {
namespace {

PointCloud cloud() {
  return grid_patch({0, 0, 1}, {0.01f, 0, 0}, {0, 0.01f, 0}, 6, 4);
}

std::vector<std::uint32_t> labels() {
  std::vector<std::uint32_t> result(24);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = static_cast<std::uint32_t>(70'000 * i);
  return result;
}

TEST(LabelDecoder, GivesTheLabelsThatWereSent) {
  EXPECT_EQ(decode_labels(encode(make_point_cloud({}, cloud(), {}, labels()))), labels());
  const std::vector<std::uint32_t> rgb(24, 0x102030);
  EXPECT_EQ(decode_labels(encode(make_point_cloud({}, cloud(), rgb, labels()))), labels());
}

TEST(LabelDecoder, TakesShorterIntegers) {
  point_cloud_t message = make_point_cloud({}, cloud(), {}, labels());
  for (auto& field : message.fields)
    if (field.name == "label") field.datatype = 2;  // UINT8
  auto expected = labels();
  for (auto& label : expected) label &= 0xff;
  EXPECT_EQ(decode_labels(encode(message)), expected);
}

TEST(LabelDecoder, NoLabelsInOtherMessages) {
  EXPECT_TRUE(decode_labels({}).empty());
  EXPECT_TRUE(decode_labels(encode(make_point_cloud({}, cloud()))).empty());
  EXPECT_TRUE(decode_labels(
                  encode(make_depth_image({}, {2, 1, 500, 500, 1, 1, 0.001}, std::vector<std::uint16_t>(2))))
                  .empty());
  point_cloud_t message = make_point_cloud({}, cloud(), {}, labels());
  for (auto& field : message.fields)
    if (field.name == "label") field.datatype = 7;  // FLOAT32
  EXPECT_TRUE(decode_labels(encode(message)).empty());
}

TEST(LabelDecoder, TrustsNothing) {
  const auto whole = encode(make_point_cloud({}, cloud(), {}, labels()));
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_TRUE(decode_labels(std::span(whole).first(size)).empty()) << size;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const auto flip : {std::byte{0x01}, std::byte{0x80}, std::byte{0xff}}) {
      auto damaged = whole;
      damaged[i] ^= flip;
      const std::size_t n = decode_labels(damaged).size();
      EXPECT_TRUE(n == 0 || n == 24) << i;
    }
  }
}

}  // namespace
}  // namespace graspd
