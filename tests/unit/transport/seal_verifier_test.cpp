// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/seal_verifier.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tests/unit/transport/message_samples.hpp"

namespace graspd {
namespace {

constexpr std::int64_t kNow = 1'700'000'000'000'000;
constexpr std::int64_t kMaxAge = 5'000'000;

class SealVerifierTest : public testing::Test {
 protected:
  /// Why a message with this header is refused at that time; the reason's name, empty: it is not.
  std::string open(const SealHeader& header, std::int64_t now = kNow) {
    Bytes bytes;
    seal(SealKey{}, header, "CLOUD", Bytes(4), bytes);
    const auto result = verifier_.open("CLOUD", bytes, now);
    const auto* refusal = std::get_if<Refusal>(&result);
    return refusal != nullptr ? std::string(name(refusal->reason)) : "";
  }

  SealVerifier verifier_{{SealKey{}}, kMaxAge};
};

TEST_F(SealVerifierTest, TakesEachMessageOnce) {
  EXPECT_EQ(open({1, 1, kNow}), "");
  EXPECT_EQ(open({1, 1, kNow}), "replayed");
  EXPECT_EQ(open({1, 2, kNow}), "");
  EXPECT_EQ(open({1, 1, kNow}), "replayed");
}

TEST_F(SealVerifierTest, MessagesMayOvertakeEachOther) {
  EXPECT_EQ(open({1, 100, kNow}), "");
  EXPECT_EQ(open({1, 37, kNow}), "");
  EXPECT_EQ(open({1, 99, kNow}), "");
  EXPECT_EQ(open({1, 99, kNow}), "replayed");
  EXPECT_EQ(open({1, 36, kNow}), "replayed") << "may have come";
  EXPECT_EQ(open({1, 1000, kNow}), "");
  EXPECT_EQ(open({1, 100, kNow}), "replayed");
}

TEST_F(SealVerifierTest, SequencesOfAllNumbers) {
  constexpr auto kMin = std::numeric_limits<std::int64_t>::min();
  constexpr auto kMax = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(open({1, kMin, kNow}), "");
  EXPECT_EQ(open({1, kMax, kNow}), "");
  EXPECT_EQ(open({1, kMin, kNow}), "replayed");
  EXPECT_EQ(open({1, kMax, kNow}), "replayed");
}

TEST_F(SealVerifierTest, SendersCountByThemselves) {
  EXPECT_EQ(open({1, 1, kNow}), "");
  EXPECT_EQ(open({2, 1, kNow}), "");
  EXPECT_EQ(open({2, 1, kNow}), "replayed");
}

TEST_F(SealVerifierTest, RefusesOtherTimes) {
  EXPECT_EQ(open({1, 1, kNow - kMaxAge - 1}), "stale");
  EXPECT_EQ(open({1, 2, kNow + kMaxAge + 1}), "stale");
  EXPECT_EQ(open({1, 3, kNow - kMaxAge}), "");
  EXPECT_EQ(open({1, 4, kNow + kMaxAge}), "");
  EXPECT_EQ(open({1, 5, std::numeric_limits<std::int64_t>::min()}), "stale");
  EXPECT_EQ(open({1, 6, std::numeric_limits<std::int64_t>::max()}), "stale");
}

TEST_F(SealVerifierTest, WhatWasStaleIsNotNoted) {
  EXPECT_EQ(open({1, 1, kNow}, kNow + 2 * kMaxAge), "stale");
  EXPECT_EQ(open({1, 1, kNow}), "");
}

TEST_F(SealVerifierTest, AClockSetBackOpensNoOldMessage) {
  EXPECT_EQ(open({1, 1, kNow}), "");
  EXPECT_EQ(open({1, 2, kNow + 100 * kMaxAge}, kNow + 100 * kMaxAge), "");
  EXPECT_EQ(open({1, 1, kNow}, kNow), "replayed");
}

TEST_F(SealVerifierTest, ForgottenSendersCannotBeReplayed) {
  const auto senders = static_cast<std::int64_t>(SealVerifier::kMaxSenders);
  for (std::int64_t i = 0; i < senders + 10; ++i) EXPECT_EQ(open({i, 1, kNow + i}), "");
  EXPECT_EQ(open({0, 1, kNow}), "stale") << "forgotten, and so is all that it can have sent";
  EXPECT_EQ(open({senders + 9, 1, kNow + senders + 9}), "replayed");
  EXPECT_EQ(open({0, 2, kNow + senders + 100}), "") << "a message of its own later goes through";
}

TEST_F(SealVerifierTest, UnsignedMessagesAreRefused) {
  const auto result = verifier_.open("CLOUD", raw_bytes(small_point_cloud()), kNow);
  EXPECT_EQ(std::get<Refusal>(result).reason, RefusalReason::kUnsigned);
}

}  // namespace
}  // namespace graspd
