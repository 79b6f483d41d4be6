// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/web/web_token.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

constexpr const char* kVariable = "GRASPD_TEST_TOKEN";
const std::string kLong = "sixteen letters!";

std::string token_of_file(const std::string& content) {
  const TempFolder folder;
  return given_token({folder.write("token", content).string(), kVariable});
}

std::string token_of_environment(const std::string& value) {
  setenv(kVariable, value.c_str(), 1);
  try {
    const std::string token = given_token({"", kVariable});
    unsetenv(kVariable);
    return token;
  } catch (...) {
    unsetenv(kVariable);
    throw;
  }
}

TEST(WebToken, IsTheFirstLineOfAFile) {
  EXPECT_EQ(token_of_file(kLong), kLong);
  EXPECT_EQ(token_of_file(kLong + "\nmore\n"), kLong);
  EXPECT_EQ(token_of_file(kLong + "\r\n"), kLong);
}

TEST(WebToken, OrOfTheEnvironment) {
  EXPECT_EQ(token_of_environment(kLong), kLong);
  EXPECT_EQ(given_token({"", kVariable}), "") << "none is given";
  setenv(kVariable, "the environment's token", 1);
  EXPECT_EQ(token_of_file(kLong), kLong) << "a file counts more";
  unsetenv(kVariable);
}

TEST(WebToken, WhatCanBeGuessedOrNotSentIsRefused) {
  for (const std::string& bad :
       {std::string(), kLong.substr(1), kLong + "\t", kLong + "\xc3\xa9", kLong + "\x7f"}) {
    EXPECT_THROW((void)token_of_file(bad), std::runtime_error) << bad;
    EXPECT_THROW((void)token_of_environment(bad), std::runtime_error) << bad;
  }
  EXPECT_THROW((void)given_token({"/no/such/file", kVariable}), std::runtime_error);
  EXPECT_THROW((void)given_token({"/tmp", kVariable}), std::runtime_error);
}

TEST(WebToken, ErrorsNameThePlaceAndNotTheToken) {
  try {
    (void)token_of_environment("secret");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), std::string(kVariable) + ": the token is shorter than 16 characters");
  }
}

}  // namespace
}  // namespace graspd
