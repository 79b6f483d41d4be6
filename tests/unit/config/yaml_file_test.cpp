// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/yaml_file.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "tests/support/temp_folder.hpp"
#include "tests/unit/config/config_error_text.hpp"

namespace graspd {
namespace {

using namespace std::string_view_literals;

std::string error_of(std::string_view text) {
  const TempFolder folder;
  const auto file = folder.write("f.yaml", text);
  return config_error(file, [&] { static_cast<void>(load_yaml(file)); });
}

TEST(YamlFile, EmptyIsNull) {
  const TempFolder folder;
  EXPECT_TRUE(load_yaml(folder.write("f.yaml", "")).IsNull());
  EXPECT_TRUE(load_yaml(folder.write("f.yaml", "# only a comment\n")).IsNull());
}

TEST(YamlFile, UnreadableFiles) {
  const TempFolder folder;
  const auto missing = folder.path() / "missing.yaml";
  EXPECT_EQ(config_error(missing, [&] { static_cast<void>(load_yaml(missing)); }), "no such file");
  EXPECT_EQ(config_error(folder.path(), [&] { static_cast<void>(load_yaml(folder.path())); }),
            "not a regular file");
  EXPECT_EQ(config_error("/dev/zero", [&] { static_cast<void>(load_yaml("/dev/zero")); }),
            "not a regular file");
}

TEST(YamlFile, HugeFiles) {
  EXPECT_EQ(error_of(std::string(kMaxConfigBytes + 1, '#')),
            "too large for a configuration (got more than 1048576 bytes, expected at most 1048576 bytes)");
  EXPECT_EQ(error_of(std::string(kMaxConfigBytes, '#')), "");
}

TEST(YamlFile, NotText) {
  constexpr const char* kNotText = "not a text file (got bytes that are not UTF-8, expected YAML in UTF-8)";
  EXPECT_EQ(error_of("a: \xff\xfe"), kNotText);
  EXPECT_EQ(error_of("a: \0b"sv), kNotText);
  EXPECT_EQ(error_of("a: \xc3"), kNotText);
}

TEST(YamlFile, NotYaml) {
  EXPECT_EQ(error_of("a: [1, 2"), "line 1, column 1: not YAML: end of sequence flow not found");
  EXPECT_EQ(error_of("a: 1\n b: 2\n").substr(0, 27), "line 2, column 3: not YAML:");
  EXPECT_EQ(error_of("a: *nowhere\n").substr(0, 27), "line 1, column 4: not YAML:");
}

/// yaml-cpp's own LoadAll reads such a file for ever, and takes all the memory there is.
TEST(YamlFile, ACommaAtTheStartEnds) {
  EXPECT_EQ(error_of(",*a\n"), "more than one document (expected 1)");
  EXPECT_NE(error_of(std::string(1000, ',') + "[*a\n"), "");
}

TEST(YamlFile, LimitsOnWhatIsInside) {
  constexpr std::string_view kTooDeep = "too many levels (expected at most 32)";
  EXPECT_EQ(error_of("a: " + std::string(31, '[') + std::string(31, ']')), "");
  EXPECT_EQ(error_of("a: " + std::string(32, '[') + std::string(32, ']')), kTooDeep);
  std::string many;
  for (std::size_t i = 0; i < kMaxConfigNodes; ++i) many += "- 1\n";
  EXPECT_EQ(error_of(many), "too many values (expected at most 20000)");
  // Nine aliases of nine aliases of ...: one tree, whatever it would unfold to.
  std::string bomb = "a: &a [x, x]\n";
  for (char c = 'b'; c < 'z'; ++c) {
    bomb += std::string(1, c) + ": &" + c + " [";
    for (int i = 0; i < 9; ++i) bomb += std::string(i > 0 ? ", " : "") + "*" + static_cast<char>(c - 1);
    bomb += "]\n";
  }
  EXPECT_EQ(error_of(bomb), "");
}

TEST(YamlFile, DeepNestingIsAnErrorAndNoCrash) {
  EXPECT_NE(error_of(std::string(200'000, '[')), "");
  EXPECT_NE(error_of(std::string(200'000, '{')), "");
}

TEST(YamlFile, SeveralDocuments) {
  EXPECT_EQ(error_of("a: 1\n---\nb: 2\n"), "more than one document (expected 1)");
}

TEST(Utf8, AcceptsWhatIsValid) {
  EXPECT_TRUE(is_utf8_text(""));
  EXPECT_TRUE(is_utf8_text("plain \t\n"));
  EXPECT_TRUE(is_utf8_text("\xc3\xa4 \xe2\x82\xac \xf0\x9f\xa4\x96 \xf4\x8f\xbf\xbf"));
}

TEST(Utf8, RefusesWhatIsNot) {
  for (const std::string_view text :
       {"\0"sv, "\x80"sv, "\xc0\xaf"sv, "\xe0\x80\xaf"sv, "\xed\xa0\x80"sv, "\xf4\x90\x80\x80"sv,
        "\xf5\x80\x80\x80"sv, "\xe2\x82"sv, "\xe2\x28\xa1"sv})
    EXPECT_FALSE(is_utf8_text(text));
}

}  // namespace
}  // namespace graspd
