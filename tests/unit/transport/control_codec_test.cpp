// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/control_codec.hpp"

#include <gtest/gtest.h>

#include <string>

#include "service/transport/message_parts.hpp"
#include "tests/unit/transport/allocations.hpp"
#include "tests/unit/transport/message_samples.hpp"

namespace graspd {
namespace {

TEST(ControlCodec, EqualsTheGeneratedDecoderOnValidMessages) {
  Random random(60);
  for (int i = 0; i < 200; ++i) {
    const Bytes message = encode(random_control(random));
    ASSERT_EQ(message, raw_bytes(generated_decode<control_t>(message)));
    const auto control = decode_control(message);
    ASSERT_TRUE(control.has_value());
    ASSERT_EQ(encode(*control), message);
  }
}

TEST(ControlCodec, RefusesTruncatedLongerAndForeignMessages) {
  Random random(61);
  Bytes message = encode(random_control(random));
  for_each_truncation(message, [](const Bytes& part) { EXPECT_FALSE(decode_control(part).has_value()); });
  message.push_back({});
  EXPECT_FALSE(decode_control(message).has_value());
  EXPECT_FALSE(decode_control(raw_bytes(random_status(random))).has_value());
}

TEST(ControlCodec, RefusesCommandsIdsAndTextsThatCannotBe) {
  Random random(62);
  const control_t good = random_control(random);
  control_t bad = good;
  for (const int command : {-128, -1, 4, 127}) {
    bad.command = static_cast<std::int8_t>(command);
    EXPECT_FALSE(decode_control(encode(bad)).has_value()) << command;
  }
  bad = good;
  for (const std::int64_t id : {std::int64_t{0}, std::int64_t{-1}}) {
    bad.id = id;
    EXPECT_FALSE(decode_control(encode(bad)).has_value()) << id;
  }
  bad = good;
  bad.text.assign(static_cast<std::size_t>(kMaxOverridesLength), 'x');
  EXPECT_TRUE(decode_control(encode(bad)).has_value());
  bad.text += 'x';
  EXPECT_FALSE(decode_control(encode(bad)).has_value());
}

TEST(ControlCodec, SurvivesEveryCorruption) {
  Random random(63);
  const Bytes message = encode(random_control(random));
  forget_allocations();
  for_each_corruption(message, [](const Bytes& corrupt) { (void)decode_control(corrupt); });
  EXPECT_LT(largest_allocation(), 100'000u);
}

}  // namespace
}  // namespace graspd
