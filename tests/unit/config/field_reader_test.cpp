// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/field_reader.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "tests/unit/config/config_error_text.hpp"

namespace graspd {
namespace {

enum class Colour { kRed, kGreen };
constexpr std::array<std::string_view, 2> choices(Colour) {
  return {"red", "green"};
}

struct Inner {
  float low = 1;
  float high = 2;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("low", self.low, Range{0, 10}, "low [m]");
    v("high", self.high, Range{0, 10}, "high [m]");
  }
  [[nodiscard]] std::optional<ConfigProblem> validate() const {
    if (low < high) return std::nullopt;
    return ConfigProblem{"high", "nothing in between: expected more than low"};
  }
};

struct Everything {
  bool flag = false;
  int count = 3;
  float part = 0.5f;
  double angle = 1;
  std::string text = "x";
  std::vector<double> list;
  Eigen::Vector3f point{1, 2, 3};
  Colour colour = Colour::kRed;
  Inner inner;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("flag", self.flag, Range{}, "yes or no");
    v("count", self.count, Range{1, 9}, "how many");
    v("part", self.part, Range{0, 0.1}, "share");
    v("angle", self.angle, Range{}, "angle [rad]");
    v("text", self.text, Range{}, "words");
    v("list", self.list, Range{0, 5}, "numbers");
    v("point", self.point, Range{-5, 5}, "place [m]");
    v("colour", self.colour, Range{}, "red or green");
    v("inner", self.inner, "nested");
  }
};

Everything read(const std::string& yaml) {
  Everything value;
  read_struct(YAML::Load(yaml), ConfigPlace{"f", ""}, value);
  return value;
}

std::string error_of(const std::string& yaml) {
  return config_error("f", [&] { static_cast<void>(read(yaml)); });
}

TEST(FieldReader, NothingKeepsEverything) {
  const Everything value = read("");
  EXPECT_EQ(value.count, 3);
  EXPECT_EQ(value.inner.high, 2);
}

TEST(FieldReader, ReadsEveryType) {
  const Everything value = read(
      "{flag: true, count: +7, part: 0.1, angle: -1e-3, text: a b, list: [1, 2.5], point: [-1, 0, 5], "
      "colour: green, "
      "inner: {high: 9}}");
  EXPECT_TRUE(value.flag);
  EXPECT_EQ(value.count, 7);
  EXPECT_EQ(value.part, 0.1f);  // on the border as written, beyond it as a float
  EXPECT_EQ(value.angle, -1e-3);
  EXPECT_EQ(value.text, "a b");
  EXPECT_EQ(value.list, (std::vector<double>{1, 2.5}));
  EXPECT_EQ(value.point, Eigen::Vector3f(-1, 0, 5));
  EXPECT_EQ(value.colour, Colour::kGreen);
  EXPECT_EQ(value.inner.low, 1);
  EXPECT_EQ(value.inner.high, 9);
}

TEST(FieldReader, AnchorsAreWelcome) {
  EXPECT_EQ(read("{list: &a [1, 2], point: [0, 0, 0]}").list.size(), 2u);
}

struct Wrong {
  const char* yaml;
  const char* line;
};

class FieldReaderErrors : public testing::TestWithParam<Wrong> {};

TEST_P(FieldReaderErrors, OneExactLine) {
  EXPECT_EQ(error_of(GetParam().yaml), GetParam().line);
}

INSTANTIATE_TEST_SUITE_P(
    Types, FieldReaderErrors,
    testing::Values(
        Wrong{"flag: yes", "flag: wrong type (got yes, expected true or false)"},
        Wrong{"flag: \"true\"", "flag: wrong type (got \"true\", expected true or false)"},
        Wrong{"flag:", "flag: wrong type (got nothing, expected true or false)"},
        Wrong{"count: 1.5", "count: wrong type (got 1.5, expected a whole number, 1 to 9)"},
        Wrong{"count: 0x5", "count: wrong type (got 0x5, expected a whole number, 1 to 9)"},
        Wrong{"count: \"5\"", "count: wrong type (got \"5\", expected a whole number, 1 to 9)"},
        Wrong{"count: 99999999999999999999",
              "count: wrong type (got 99999999999999999999, expected a whole number, 1 to 9)"},
        Wrong{"part: 5 mm", "part: wrong type (got 5 mm, expected a number, 0 to 0.1)"},
        Wrong{"part: [1]", "part: wrong type (got a list of 1, expected a number, 0 to 0.1)"},
        Wrong{"angle: {a: 1}", "angle: wrong type (got a map, expected a number)"},
        Wrong{"angle: 1e999", "angle: wrong type (got 1e999, expected a number)"},
        Wrong{"text: [a]", "text: wrong type (got a list of 1, expected a text)"},
        Wrong{"text:", "text: wrong type (got nothing, expected a text)"},
        Wrong{"list: 3", "list: wrong type (got 3, expected a list)"},
        Wrong{"list: [1, x]", "list[1]: wrong type (got x, expected a number, 0 to 5)"},
        Wrong{"point: [1, 2]", "point: wrong type (got a list of 2, expected a list of 3 numbers)"},
        Wrong{"point: [1, 2, [3]]", "point[2]: wrong type (got a list of 1, expected a number, -5 to 5)"},
        Wrong{"colour: blue", "colour: unknown value (got blue, expected red or green)"},
        Wrong{"inner: 5", "inner: wrong type (got 5, expected a map of keys and values)"},
        Wrong{"[1, 2]", "wrong type (got a list of 2, expected a map of keys and values)"}));

INSTANTIATE_TEST_SUITE_P(
    Ranges, FieldReaderErrors,
    testing::Values(Wrong{"count: 0", "count: out of range (got 0, expected 1 to 9)"},
                    Wrong{"count: 10", "count: out of range (got 10, expected 1 to 9)"},
                    Wrong{"part: 0.10001", "part: out of range (got 0.10001, expected 0 to 0.1)"},
                    Wrong{"part: nan", "part: out of range (got nan, expected 0 to 0.1)"},
                    Wrong{"angle: inf", "angle: out of range (got inf, expected a number)"},
                    Wrong{"list: [1, -1]", "list[1]: out of range (got -1, expected 0 to 5)"},
                    Wrong{"point: [1, 2, 5.5]", "point[2]: out of range (got 5.5, expected -5 to 5)"},
                    Wrong{"inner: {low: 11}", "inner.low: out of range (got 11, expected 0 to 10)"}));

INSTANTIATE_TEST_SUITE_P(
    Keys, FieldReaderErrors,
    testing::Values(
        Wrong{"cuont: 5", "cuont: unknown key, did you mean count? (got cuont, expected count)"},
        Wrong{"inner: {hihg: 5}", "inner.hihg: unknown key, did you mean high? (got hihg, expected high)"},
        Wrong{"inner: {wavelength: 5}",
              "inner.wavelength: unknown key (got wavelength, expected one of low, high)"},
        Wrong{"{count: 5, flag: true, count: 6}", "count: given twice"},
        Wrong{"{<<: {count: 5}}",
              "<<: unknown key (got <<, expected one of flag, count, part, angle, text, list, point, "
              "colour, inner)"},
        Wrong{"{[1]: 5}", "wrong type of key (got a list of 1, expected a word)"},
        Wrong{"inner: &x {low: 0, self: *x}",
              "inner.self: unknown key (got self, expected one of low, high)"}));

INSTANTIATE_TEST_SUITE_P(
    Rules, FieldReaderErrors,
    testing::Values(Wrong{"inner: {low: 5, high: 4}",
                          "inner.high: nothing in between (got 4, expected more than low)"},
                    // The default is the other half.
                    Wrong{"inner: {low: 5}", "inner.high: nothing in between (expected more than low)"}));

TEST(FieldReader, RequiredKeys) {
  Everything value;
  const std::vector<std::string> required{"count", "text"};
  const auto error = [&](const char* yaml) {
    return config_error("f", [&] { read_struct(YAML::Load(yaml), ConfigPlace{"f", ""}, value, required); });
  };
  EXPECT_EQ(error("{count: 1, text: a}"), "");
  EXPECT_EQ(error("count: 1"), "text: missing (got nothing, expected a value)");
  EXPECT_EQ(error(""), "count: missing (got nothing, expected a value)");
}

TEST(FieldReader, MessagesStayOnOneLine) {
  const std::string error = error_of("count: \"a\\nb\\x1b" + std::string(500, 'c') + "\"");
  EXPECT_EQ(error.find('\n'), std::string::npos);
  EXPECT_EQ(error.find('\x1b'), std::string::npos);
  EXPECT_LT(error.size(), 150u);
}

}  // namespace
}  // namespace graspd
