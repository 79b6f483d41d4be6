// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/status_codec.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "tests/unit/transport/allocations.hpp"
#include "tests/unit/transport/message_samples.hpp"

namespace graspd {
namespace {

TEST(StatusCodec, EqualsTheGeneratedDecoderOnValidMessages) {
  Random random(48);
  for (int i = 0; i < 500; ++i) {
    const Bytes message = encode(random_status(random));
    ASSERT_EQ(message, raw_bytes(generated_decode<status_t>(message)));
    const auto status = decode_status(message);
    ASSERT_TRUE(status.has_value());
    ASSERT_EQ(encode(*status), message);
  }
}

TEST(StatusCodec, RefusesTruncatedLongerAndForeignMessages) {
  Random random(49);
  Bytes message;
  while (message.size() < 500) message = encode(random_status(random));
  for_each_truncation(message, [](const Bytes& part) { EXPECT_FALSE(decode_status(part).has_value()); });
  message.push_back({});
  EXPECT_FALSE(decode_status(message).has_value());
  EXPECT_FALSE(decode_status(raw_bytes(random_handle_list(random))).has_value());
}

TEST(StatusCodec, SurvivesEveryCorruption) {
  Random random(50);
  status_t status = random_status(random);
  while (status.num_errors == 0 || status.num_sources != 1 || status.sources[0].num_refusals == 0 ||
         status.sources[0].num_drops == 0)
    status = random_status(random);
  const Bytes message = encode(status);
  forget_allocations();
  for_each_corruption(message, [](const Bytes& corrupt) { (void)decode_status(corrupt); });
  EXPECT_LT(largest_allocation(), 100'000u);
}

TEST(StatusCodec, CountsThatLieAreRefusedOrThrow) {
  Random random(51);
  status_t status = random_status(random);
  status.sources.clear();
  status.num_sources = 0;
  Bytes message = encode(status);
  for (const std::int32_t count : {std::numeric_limits<std::int32_t>::min(), -1, 1, 0x7fffffff}) {
    put(message, message.size() - 4, count, 4);
    EXPECT_FALSE(decode_status(message).has_value());
    status.num_sources = count;
    EXPECT_THROW((void)encode(status), std::invalid_argument);
  }
  while (status.sources.empty()) status = random_status(random);
  ++status.sources[0].num_refusals;
  EXPECT_THROW((void)encode(status), std::invalid_argument);
  --status.sources[0].num_refusals;
  ++status.sources[0].num_drops;
  EXPECT_THROW((void)encode(status), std::invalid_argument);
  --status.sources[0].num_drops;
  ++status.num_errors;
  EXPECT_THROW((void)encode(status), std::invalid_argument);
}

}  // namespace
}  // namespace graspd
