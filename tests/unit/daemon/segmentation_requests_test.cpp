// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/segmentation_requests.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

namespace graspd {
namespace {

using namespace std::chrono_literals;

constexpr Clock::TimePoint kStart{1000s};

TEST(SegmentationRequests, NothingIsWantedUnasked) {
  EXPECT_FALSE(SegmentationRequests().wants("A", kStart));
}

TEST(SegmentationRequests, OneHoldsForItsChannelAndItsTime) {
  SegmentationRequests requests;
  ASSERT_TRUE(requests.add({0, "A", 2}, kStart));
  EXPECT_TRUE(requests.wants("A", kStart + 1999ms));
  EXPECT_FALSE(requests.wants("A", kStart + 2s));
  EXPECT_FALSE(requests.wants("B", kStart));
}

TEST(SegmentationRequests, OneWithoutAChannelHoldsForAll) {
  SegmentationRequests requests;
  ASSERT_TRUE(requests.add({0, "", 1}, kStart));
  EXPECT_TRUE(requests.wants("A", kStart));
  EXPECT_FALSE(requests.wants("A", kStart + 1s));
}

TEST(SegmentationRequests, AShorterOneTakesNothingFromALongerOne) {
  SegmentationRequests requests;
  ASSERT_TRUE(requests.add({0, "A", 10}, kStart));
  ASSERT_TRUE(requests.add({0, "A", 1}, kStart));
  EXPECT_TRUE(requests.wants("A", kStart + 9s));
  ASSERT_TRUE(requests.add({0, "A", 10}, kStart + 9s));
  EXPECT_TRUE(requests.wants("A", kStart + 18s));
}

TEST(SegmentationRequests, HoldNoMoreChannelsThanTheyMay) {
  SegmentationRequests requests;
  for (std::size_t i = 0; i < SegmentationRequests::kMostChannels; ++i)
    ASSERT_TRUE(requests.add({0, std::to_string(i), 10}, kStart));
  EXPECT_FALSE(requests.add({0, "one more", 10}, kStart));
  EXPECT_FALSE(requests.wants("one more", kStart));
  EXPECT_TRUE(requests.add({0, "0", 20}, kStart)) << "known";
  EXPECT_TRUE(requests.add({0, "one more", 10}, kStart + 10s)) << "the others are over";
}

}  // namespace
}  // namespace graspd
