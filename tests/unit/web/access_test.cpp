// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/web/access.hpp"

#include <gtest/gtest.h>

#include <set>

namespace graspd {
namespace {

TEST(ParseTarget, TakesPlainPathsAndTheTokenOfTheQuery) {
  EXPECT_EQ(parse_target("/")->path, "/");
  EXPECT_EQ(parse_target("/assets/a%2Db.js")->path, "/assets/a-b.js");
  EXPECT_EQ(parse_target("/socket?a=1&token=x%20y&b=2")->token, "x y");
  EXPECT_EQ(parse_target("/socket?nottoken=1")->token, "");
}

TEST(ParseTarget, RefusesWhateverCouldLeadOut) {
  for (const char* target : {"",
                             "*",
                             "index.html",
                             "/..",
                             "/../etc/passwd",
                             "/a/../../etc/passwd",
                             "/%2e%2e/etc/passwd",
                             "/%2E./x",
                             "/a%5c..%5cb",
                             "/a\\b",
                             "/.git/config",
                             "//etc/passwd",
                             "/a%00.html",
                             "/a%",
                             "/a%4",
                             "/a%zz",
                             "/a b",
                             "http://elsewhere/",
                             "/a%0d%0aSet-Cookie:x",
                             "/a%7f"})
    EXPECT_FALSE(parse_target(target)) << target;
}

TEST(Token, IsOf128BitsAndNeverTheSame) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(draw_token());
  EXPECT_EQ(tokens.size(), 100u);
  for (const std::string& token : tokens) EXPECT_EQ(token.size(), 32u);
  EXPECT_TRUE(equal_secrets("abc", "abc"));
  EXPECT_FALSE(equal_secrets("abc", "abd"));
  EXPECT_FALSE(equal_secrets("abc", "abcd"));
}

TEST(Host, LocallyOnlyTheLoopbacksNamesAreOurs) {
  const AccessRules local{true, "secret", {}};
  for (const char* host : {"localhost", "localhost:80", "127.0.0.1:8090", "[::1]:80"})
    EXPECT_FALSE(check_host(local, {"/", host, {}, {}})) << host;
  for (const char* host : {"evil.example", "evil.example:80", "localhost.evil.example", "[", "[fe80::1]", "",
                           "192.168.0.1", "127.example.org"})
    EXPECT_EQ(check_host(local, {"/", host, {}, {}}), WebEvent::kForeignHost) << host;
  EXPECT_EQ(check_host(local, {"/", {}, {}, {}}), WebEvent::kBadRequest);
  EXPECT_FALSE(check_host({false, "secret", {}}, {"/", "robot:80", {}, {}}));
}

struct SocketCase {
  std::optional<std::string_view> origin, authorization;
  std::string token;
};

SocketAccess access(const AccessRules& rules, const SocketCase& c) {
  return check_socket(rules, {"/socket", "localhost:80", c.origin, c.authorization}, {"/socket", c.token});
}

TEST(Socket, LocallyReadingIsFreeAndWritingNeedsTheToken) {
  const AccessRules rules{true, "secret", {"https://tool.example"}};
  EXPECT_FALSE(access(rules, {}).refusal);
  EXPECT_FALSE(access(rules, {}).may_write);
  EXPECT_TRUE(access(rules, {{}, {}, "secret"}).may_write);
  EXPECT_TRUE(access(rules, {{}, "Bearer secret", ""}).may_write);
  EXPECT_TRUE(access(rules, {"http://localhost:80", {}, "secret"}).may_write);
  EXPECT_FALSE(access(rules, {"https://tool.example", {}, ""}).refusal);
  EXPECT_EQ(access(rules, {{}, {}, "Secret"}).refusal, WebEvent::kBadToken);
  EXPECT_EQ(access(rules, {{}, "Bearer wrong", ""}).refusal, WebEvent::kBadToken);
  for (const char* origin :
       {"http://evil.example", "null", "", "https://localhost:80", "http://localhost:81"})
    EXPECT_EQ(access(rules, {origin, {}, "secret"}).refusal, WebEvent::kForeignOrigin) << origin;
}

TEST(Socket, BeyondThisMachineReadingNeedsTheTokenToo) {
  const AccessRules rules{false, "secret", {}};
  EXPECT_EQ(access(rules, {}).refusal, WebEvent::kBadToken);
  EXPECT_FALSE(access(rules, {{}, {}, "secret"}).refusal);
  EXPECT_TRUE(is_loopback("127.0.0.1"));
  EXPECT_TRUE(is_loopback("::1"));
  EXPECT_FALSE(is_loopback("0.0.0.0"));
  EXPECT_FALSE(is_loopback("::"));
  EXPECT_FALSE(is_loopback("127.example.org"));
}

}  // namespace
}  // namespace graspd
