// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/json_writer.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <limits>

#include "client/common/handle_text.hpp"
#include "client/simulate/rng.hpp"
#include "tests/unit/client/sample_list.hpp"

namespace graspd {
namespace {

TEST(JsonQuoted, EscapesWhatMustBe) {
  EXPECT_EQ(json_quoted("plain"), "\"plain\"");
  EXPECT_EQ(json_quoted("a\"b\\c"), "\"a\\\"b\\\\c\"");
  EXPECT_EQ(json_quoted("line\nend\t\x01\x7f"), "\"line\\u000aend\\u0009\\u0001\\u007f\"");
  EXPECT_EQ(json_quoted(std::string_view("\0", 1)), "\"\\u0000\"");
}

TEST(JsonQuoted, KeepsUtf8AndReplacesTheRest) {
  EXPECT_EQ(json_quoted("Tür 漢 😀"), "\"Tür 漢 😀\"");
  EXPECT_EQ(json_quoted("\xff"), "\"\\ufffd\"");
  EXPECT_EQ(json_quoted("a\xc3"), "\"a\\ufffd\"") << "cut off";
  EXPECT_EQ(json_quoted("\xc0\x80"), "\"\\ufffd\\ufffd\"") << "overlong";
  EXPECT_EQ(json_quoted("\xed\xa0\x80"), "\"\\ufffd\\ufffd\\ufffd\"") << "surrogate";
  EXPECT_EQ(json_quoted("\xf4\x90\x80\x80"), "\"\\ufffd\\ufffd\\ufffd\\ufffd\"") << "beyond Unicode";
}

TEST(JsonWriter, PutsCommasWhereTheyBelong) {
  JsonWriter json;
  json.begin_object().member("a", 1).key("b").begin_array().value(1.5).value("x").begin_object().end_object();
  json.begin_array()
      .end_array()
      .end_array()
      .member("c", "d")
      .member("e", std::int64_t{-9'007'199'254'740'993})
      .end_object();
  EXPECT_EQ(json.str(), R"({"a":1,"b":[1.5,"x",{},[]],"c":"d","e":-9007199254740993})");
}

TEST(JsonWriter, NumbersThatJsonCannotHoldAreNull) {
  JsonWriter json;
  json.begin_array().value(std::nan("")).value(INFINITY).value_float(-INFINITY).end_array();
  EXPECT_EQ(json.str(), "[null,null,null]");
}

TEST(JsonWriter, NumbersComeBackToTheBit) {
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    const double value = rng.normal() * std::pow(10.0, rng.index(40) - 20);
    JsonWriter as_double;
    as_double.value(value);
    EXPECT_EQ(std::strtod(as_double.str().c_str(), nullptr), value);
    JsonWriter as_float;
    as_float.value_float(static_cast<double>(static_cast<float>(value)));
    EXPECT_EQ(std::strtof(as_float.str().c_str(), nullptr), static_cast<float>(value));
  }
}

// YAML reads JSON: an independent reader.
TEST(HandleListJson, ReadsBack) {
  handle_list_t list = sample_list(4, 9);
  list.frame_name = "a \"quoted\" \\ name";
  const std::string text = handle_list_json(list);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const YAML::Node json = YAML::Load(text);
  EXPECT_EQ(json["frame_name"].as<std::string>(), list.frame_name);
  EXPECT_EQ(json["utime"].as<std::int64_t>(), list.utime);
  EXPECT_EQ(json["status"].as<std::string>(), "OK");
  EXPECT_EQ(json["candidate_failures"]["fingers"].as<int>(), 17);
  EXPECT_EQ(json["stages_ms"]["handle_check"].as<double>(), 10.5);
  EXPECT_EQ(json["latency"].as<double>(), list.latency);
  ASSERT_EQ(json["handles"].size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(json["handles"][i]["position"][k].as<float>(),
                static_cast<float>(list.handles[i].position[k]));
    }
    EXPECT_EQ(json["handles"][i]["score"].as<float>(), static_cast<float>(list.handles[i].score));
  }
}

}  // namespace
}  // namespace graspd
