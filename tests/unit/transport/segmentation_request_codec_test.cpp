// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/segmentation_request_codec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "tests/unit/transport/allocations.hpp"
#include "tests/unit/transport/message_samples.hpp"

namespace graspd {
namespace {

TEST(SegmentationRequestCodec, EqualsTheGeneratedDecoderOnValidMessages) {
  Random random(80);
  for (int i = 0; i < 200; ++i) {
    const Bytes message = encode(random_segmentation_request(random));
    ASSERT_EQ(message, raw_bytes(generated_decode<segmentation_request_t>(message)));
    const auto request = decode_segmentation_request(message);
    ASSERT_TRUE(request.has_value());
    ASSERT_EQ(encode(*request), message);
  }
}

TEST(SegmentationRequestCodec, RefusesTruncatedLongerAndForeignMessages) {
  Random random(81);
  Bytes message = encode(random_segmentation_request(random));
  for_each_truncation(message,
                      [](const Bytes& part) { EXPECT_FALSE(decode_segmentation_request(part).has_value()); });
  message.push_back({});
  EXPECT_FALSE(decode_segmentation_request(message).has_value());
  EXPECT_FALSE(decode_segmentation_request(raw_bytes(random_control(random))).has_value());
}

TEST(SegmentationRequestCodec, RefusesTimesAndChannelsThatCannotBe) {
  segmentation_request_t request{1, std::string(63, 'C'), kLongestRequest_s};
  EXPECT_TRUE(decode_segmentation_request(encode(request)).has_value());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double seconds : {0.0, -1.0, 60.001, kInfinity, -kInfinity, std::nan("")}) {
    request.seconds = seconds;
    EXPECT_FALSE(decode_segmentation_request(encode(request)).has_value()) << seconds;
  }
  request = {1, std::string(64, 'C'), 1};
  EXPECT_FALSE(decode_segmentation_request(encode(request)).has_value());
}

TEST(SegmentationRequestCodec, SurvivesEveryCorruption) {
  Random random(82);
  const Bytes message = encode(random_segmentation_request(random));
  forget_allocations();
  for_each_corruption(message, [](const Bytes& corrupt) { (void)decode_segmentation_request(corrupt); });
  EXPECT_LT(largest_allocation(), 100'000u);
}

}  // namespace
}  // namespace graspd
