// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/field_printer.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "service/config/field_reader.hpp"

namespace graspd {
namespace {

template <class T>
T read_back(const std::string& text) {
  T value{};
  read_value(YAML::Load(text), ConfigPlace{"f", ""}, Range{}, value);
  return value;
}

TEST(FieldPrinter, NumbersReadBackToTheBit) {
  std::mt19937 random(11);
  for (int i = 0; i < 20000; ++i) {
    const auto bits = static_cast<std::uint32_t>(random());
    float number = 0;
    std::memcpy(&number, &bits, sizeof(number));
    if (!std::isfinite(number)) continue;
    const float back = read_back<float>(print_value(number));
    ASSERT_EQ(back, number) << print_value(number);
  }
  for (const double number : {0.1, 1.0 / 3, 1e-300, 1.7976931348623157e308, -0.0})
    EXPECT_EQ(read_back<double>(print_value(number)), number);
  EXPECT_EQ(read_back<int>(print_value(std::numeric_limits<int>::min())), std::numeric_limits<int>::min());
}

TEST(FieldPrinter, TextsReadBack) {
  for (const char* text : {"",
                           "plain",
                           "GRASPD_CLOUD",
                           "true",
                           "No",
                           "null",
                           "~",
                           "12",
                           "1e3",
                           "a b",
                           " a",
                           "a: b",
                           "#c",
                           "\"q\"",
                           "back\\slash",
                           "CAM_.*|DEPTH_[0-9]+",
                           "{a}",
                           "tab\there",
                           "line\nbreak",
                           "\x1b[2J",
                           "\xc3\xa4",
                           "- x",
                           "*a",
                           "&a",
                           "!t",
                           "%d",
                           "@a"})
    EXPECT_EQ(read_back<std::string>(print_value(std::string(text))), text) << print_value(std::string(text));
}

TEST(FieldPrinter, CommentsSayTheRange) {
  EXPECT_EQ(comment_of("edge [m]", Range{0, 0.1}), "edge [m] (0 to 0.1)");
  EXPECT_EQ(comment_of("edge [m]", Range{0}), "edge [m] (at least 0)");
  EXPECT_EQ(comment_of("edge [m]", Range{}), "edge [m]");
}

TEST(FieldPrinter, DifferenceKeepsWhatChangedAndItsParents) {
  const std::vector<PrintedField> base{{0, "a", "", ""}, {1, "b", "1", ""}, {1, "c", "2", ""},
                                       {0, "d", "", ""}, {1, "e", "3", ""}, {0, "f", "4", ""}};
  std::vector<PrintedField> changed = base;
  EXPECT_TRUE(difference(base, changed).empty());
  changed[2].value = "5";
  EXPECT_EQ(difference(base, changed), (std::vector<PrintedField>{{0, "a", "", ""}, {1, "c", "5", ""}}));
  changed[5].value = "6";
  EXPECT_EQ(difference(base, changed),
            (std::vector<PrintedField>{{0, "a", "", ""}, {1, "c", "5", ""}, {0, "f", "6", ""}}));
}

TEST(FieldPrinter, LongCommentsGoBeforeTheirKey) {
  const std::string words(115, 'w');
  EXPECT_EQ(to_yaml({{1, "a", "1", "short"}, {1, "b", "2", words}}),
            "  a: 1  # short\n  # " + words + "\n  b: 2\n");
  EXPECT_EQ(to_yaml({{2, "a", "1", words}, {2, "b", "2", ""}}, YamlForm::kListItem),
            "    # " + words + "\n  - a: 1\n    b: 2\n");
}

}  // namespace
}  // namespace graspd
