// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/multicast_check.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>

#include "service/transport/lcm_bus.hpp"
#include "tests/unit/transport/private_network.hpp"

namespace graspd {
namespace {

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";

/// The message of what a bus's constructor throws; empty: nothing.
std::string creation_error() {
  try {
    const LcmBus bus(kUrl);
    return {};
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

std::string check_error() {
  try {
    require_multicast(kUrl);
    return {};
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

TEST(MulticastCheck, MissingRouteNamesUrlReasonAndRemedy) {
  for (const char* setup : {kNoSetup, kLoopback}) {
    const auto result = in_private_network(setup, creation_error);
    if (result.denied) GTEST_SKIP() << result.problem;
    ASSERT_EQ(result.problem, "");
    EXPECT_NE(result.text.find(kUrl), std::string::npos) << result.text;
    EXPECT_NE(result.text.find("no multicast route to 239.255.76.67"), std::string::npos) << result.text;
    EXPECT_NE(result.text.find("ip route add 239.0.0.0/8 dev lo"), std::string::npos) << result.text;
    EXPECT_EQ(result.text.find('\n'), std::string::npos);
  }
}

TEST(MulticastCheck, BlockedLoopbackIsToldBeforeLcmStalls) {
  const auto result = in_private_network(kBlockedMulticast, creation_error);
  if (result.denied) GTEST_SKIP() << result.problem;
  ASSERT_EQ(result.problem, "");
  EXPECT_NE(result.text.find("239.255.76.67:7667 does not come back to this machine"), std::string::npos)
      << result.text;
  EXPECT_NE(result.text.find("firewall"), std::string::npos) << result.text;
}

TEST(MulticastCheck, SaysNothingWhenAllIsWell) {
  const auto result = in_private_network(kMulticast, check_error);
  if (result.denied) GTEST_SKIP() << result.problem;
  EXPECT_EQ(result.problem, "");
  EXPECT_EQ(result.text, "");
}

TEST(MulticastCheck, UrlsThatAreNoGroupThrow) {
  EXPECT_THROW(require_multicast("udpm://1.2.3.4:7667"), std::runtime_error);
  EXPECT_THROW(require_multicast("udpm://239.255.76.67:0"), std::runtime_error);
}

}  // namespace
}  // namespace graspd
