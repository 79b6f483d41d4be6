// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes JSON text, one value after the other.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace graspd {

/// A JSON string with its quotes. Bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string json_quoted(std::string_view text);

/// The same text, with U+FFFD for each byte that is not UTF-8.
[[nodiscard]] std::string valid_utf8(std::string_view text);

/// Puts commas where they belong; the caller closes what it opens. Numbers that JSON cannot hold become null.
class JsonWriter {
 public:
  JsonWriter& begin_object();
  JsonWriter& end_object();
  JsonWriter& begin_array();
  JsonWriter& end_array();
  JsonWriter& key(std::string_view name);

  JsonWriter& value(std::string_view text);
  JsonWriter& value(std::int64_t number);
  JsonWriter& value(double number);        ///< 17 digits: the same double when read back
  JsonWriter& value_float(double number);  ///< 9 digits: the same float when read back

  template <class T>
  JsonWriter& member(std::string_view name, const T& content) {
    key(name);
    if constexpr (std::is_convertible_v<T, std::string_view>) {
      return value(std::string_view(content));
    } else if constexpr (std::is_floating_point_v<T>) {
      return value(static_cast<double>(content));
    } else {
      return value(static_cast<std::int64_t>(content));
    }
  }

  [[nodiscard]] const std::string& str() const { return text_; }

 private:
  void separate();
  JsonWriter& number(double number, int digits);

  std::string text_;
  std::vector<bool> has_values_;  // one for each open object or array
  bool after_key_ = false;
};

}  // namespace graspd
