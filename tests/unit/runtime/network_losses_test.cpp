// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/network_losses.hpp"

#include <gtest/gtest.h>

namespace graspd {
namespace {

constexpr const char* kText =
    "Ip: Forwarding ReasmFails\nIp: 1 12\nUdp: InDatagrams RcvbufErrors MemErrors\nUdp: 5 77 0\n"
    "UdpLite: InDatagrams RcvbufErrors\nUdpLite: 1 2\nTcp: A\nTcp: -1\nIcmp: A B\nIcmp: 1\nLast: A";

TEST(SnmpValue, FindsByProtocolAndName) {
  EXPECT_EQ(snmp_value(kText, "Udp", "RcvbufErrors"), 77);
  EXPECT_EQ(snmp_value(kText, "UdpLite", "RcvbufErrors"), 2);
  EXPECT_EQ(snmp_value(kText, "Ip", "ReasmFails"), 12);
  EXPECT_EQ(snmp_value(kText, "Tcp", "A"), -1);
}

TEST(SnmpValue, NothingWhereThereIsNone) {
  EXPECT_FALSE(snmp_value(kText, "Udp", "Rcvbuf"));
  EXPECT_FALSE(snmp_value(kText, "Icmp", "B")) << "fewer values than names";
  EXPECT_FALSE(snmp_value(kText, "Last", "A")) << "no values";
  EXPECT_FALSE(snmp_value(kText, "None", "A"));
  EXPECT_FALSE(snmp_value("", "Udp", "RcvbufErrors"));
  EXPECT_FALSE(snmp_value("Udp: A\nUdp: x\n", "Udp", "A"));
}

TEST(NetworkLossMeter, CountsFromItsStart) {
  const NetworkLossMeter meter;
  EXPECT_GE(meter.measure().receive_errors, 0);
  EXPECT_GE(meter.measure().reassembly_errors, 0);
}

}  // namespace
}  // namespace graspd
