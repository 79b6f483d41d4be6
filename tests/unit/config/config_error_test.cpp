// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/config_error.hpp"

#include <gtest/gtest.h>

namespace graspd {
namespace {

std::string line(const ConfigPlace& place, const std::string& got, const std::string& expected) {
  try {
    place.fail("reason", got, expected);
  } catch (const ConfigError& e) {
    return e.what();
  }
}

TEST(ConfigError, SaysFilePlaceReasonGotAndExpected) {
  const ConfigPlace place = ConfigPlace{"f.yaml", ""}.child("sources").item(2).child("channel");
  EXPECT_EQ(line(place, "X", "Y"), "f.yaml: sources[2].channel: reason (got X, expected Y)");
  EXPECT_EQ(line(place, "X", ""), "f.yaml: sources[2].channel: reason (got X)");
  EXPECT_EQ(line(place, "", "Y"), "f.yaml: sources[2].channel: reason (expected Y)");
  EXPECT_EQ(line({"f.yaml", ""}, "", ""), "f.yaml: reason");
}

}  // namespace
}  // namespace graspd
