// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/lcm_url.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

namespace graspd {
namespace {

class ResolveLcmUrl : public testing::Test {
 protected:
  void SetUp() override {
    const char* value = std::getenv("LCM_DEFAULT_URL");
    if (value != nullptr) saved_ = value;
    unsetenv("LCM_DEFAULT_URL");
  }
  void TearDown() override {
    if (saved_.empty()) {
      unsetenv("LCM_DEFAULT_URL");
    } else {
      setenv("LCM_DEFAULT_URL", saved_.c_str(), 1);
    }
  }

 private:
  std::string saved_;
};

TEST_F(ResolveLcmUrl, OptionThenEnvironmentThenDefault) {
  EXPECT_EQ(resolve_lcm_url(""), "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304");
  setenv("LCM_DEFAULT_URL", "memq://", 1);
  EXPECT_EQ(resolve_lcm_url(""), "memq://");
  EXPECT_EQ(resolve_lcm_url("file:///log"), "file:///log");
  setenv("LCM_DEFAULT_URL", "", 1);
  EXPECT_EQ(resolve_lcm_url(""), "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304");
}

TEST_F(ResolveLcmUrl, AddsAReceiveBufferToUdpAlone) {
  EXPECT_EQ(resolve_lcm_url("udpm://"), "udpm://?recv_buf_size=4194304");
  EXPECT_EQ(resolve_lcm_url("udpm://?"), "udpm://?recv_buf_size=4194304");
  EXPECT_EQ(resolve_lcm_url("udpm://239.1.1.1:7"), "udpm://239.1.1.1:7?recv_buf_size=4194304");
  EXPECT_EQ(resolve_lcm_url("udpm://:7?ttl=1"), "udpm://:7?ttl=1&recv_buf_size=4194304");
  EXPECT_EQ(resolve_lcm_url("udpm://:7?recv_buf_size=5&ttl=1"), "udpm://:7?recv_buf_size=5&ttl=1");
  EXPECT_EQ(resolve_lcm_url("tcpq://host:7700"), "tcpq://host:7700");
}

TEST(LcmUrl, Parses) {
  const LcmUrl url = parse_lcm_url("udpm://239.1.2.3:99?ttl=1&recv_buf_size=7,flag&=none");
  EXPECT_EQ(url.provider, "udpm");
  EXPECT_EQ(url.network, "239.1.2.3:99");
  EXPECT_EQ(url.options,
            (std::map<std::string, std::string>{{"ttl", "1"}, {"recv_buf_size", "7"}, {"flag", ""}}));
  EXPECT_EQ(parse_lcm_url("memq://").network, "");
  for (const char* bad : {"", "udpm", "://x", "udpm:/239.1.1.1"})
    EXPECT_THROW((void)parse_lcm_url(bad), std::runtime_error);
}

TEST(LcmUrl, MulticastGroupHasLcmsDefaults) {
  EXPECT_EQ(multicast_group("udpm://").address, "239.255.76.67");
  EXPECT_EQ(multicast_group("udpm://").port, 7667);
  EXPECT_EQ(multicast_group("udpm://239.1.1.1").port, 7667);
  EXPECT_EQ(multicast_group("udpm://:99?ttl=0").address, "239.255.76.67");
  EXPECT_EQ(multicast_group("udpm://:99?ttl=0").port, 99);
  for (const char* bad : {"udpm://host:1", "udpm://10.0.0.1", "udpm://239.1.1.1:0", "udpm://239.1.1.1:65536",
                          "udpm://239.1.1.1:7x", "udpm://239.1.1"}) {
    EXPECT_THROW((void)multicast_group(bad), std::runtime_error) << bad;
  }
}

TEST(LcmUrl, WarnsOfReceiveBuffersThatTheKernelCuts) {
  const auto warnings =
      receive_buffer_warnings("udpm://?recv_buf_size=1073741824");  // more than any rmem_max here
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("sysctl -w net.core.rmem_max=1073741824"), std::string::npos) << warnings[0];
  EXPECT_TRUE(receive_buffer_warnings("udpm://?recv_buf_size=65536").empty());
  EXPECT_TRUE(receive_buffer_warnings("memq://").empty());
  EXPECT_THROW((void)receive_buffer_warnings("udpm://?recv_buf_size=4MB"), std::runtime_error);
}

}  // namespace
}  // namespace graspd
