// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/network_check.hpp"

#include <gtest/gtest.h>

#include "tests/unit/transport/private_network.hpp"

namespace graspd {
namespace {

constexpr std::int64_t kKernelDefault = 4 << 20;

TEST(NetworkCheck, WarnsOfLittleRoomForPiecesFromOtherMachines) {
  const auto warning = fragment_warning("udpm://239.255.76.67:7667?ttl=1", kKernelDefault);
  ASSERT_TRUE(warning);
  EXPECT_EQ(warning->kind, "fragment_space");
  EXPECT_NE(warning->text.find("sysctl -w net.ipv4.ipfrag_high_thresh=268435456"), std::string::npos);
  EXPECT_EQ(warning->text.find('\n'), std::string::npos);
}

TEST(NetworkCheck, SaysNothingWhereItDoesNotMatter) {
  EXPECT_FALSE(fragment_warning("udpm://239.255.76.67:7667?ttl=1", 256 << 20));
  for (const char* url : {"udpm://239.255.76.67:7667?ttl=0", "udpm://", "memq://", "tcpq://host?ttl=1"})
    EXPECT_FALSE(fragment_warning(url, kKernelDefault)) << url;
}

TEST(NetworkCheck, OneWarningEach) {
  const auto result = in_private_network(kMulticast, [] {
    std::string kinds;
    for (const NetworkWarning& warning : network_warnings("udpm://?ttl=1&recv_buf_size=1073741824"))
      kinds += warning.kind + " ";
    return kinds;
  });
  if (result.denied) GTEST_SKIP() << result.problem;
  // A new namespace has the kernel's default for pieces, whatever the machine's own is.
  EXPECT_TRUE(result.text == "receive_buffer fragment_space " || result.text == "receive_buffer ")
      << result.text;
  EXPECT_TRUE(network_warnings("memq://").empty());
}

}  // namespace
}  // namespace graspd
