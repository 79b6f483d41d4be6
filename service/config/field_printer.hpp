// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Prints configuration structs by their visit(): YAML lines with what each key means.
#pragma once
#include <Eigen/Core>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "service/config/source_config.hpp"
#include "service/pipeline/config_fields.hpp"

namespace graspd {

/// A key with its value, or the beginning of a nested struct.
struct PrintedField {
  int depth = 0;
  std::string key;
  std::string value;  ///< empty for a nested struct or a list of structs
  std::string comment;
  bool operator==(const PrintedField&) const = default;
};

[[nodiscard]] std::string print_value(bool value);
[[nodiscard]] std::string print_value(std::int64_t value);
[[nodiscard]] std::string print_value(int value);
/// The shortest text that reads back to the same number.
[[nodiscard]] std::string print_value(float value);
[[nodiscard]] std::string print_value(double value);
/// In quotes where YAML needs them.
[[nodiscard]] std::string print_value(const std::string& value);
[[nodiscard]] std::string print_value(const Eigen::Vector3f& value);
/// By name where it is an installed one, else in full.
[[nodiscard]] std::string print_value(const GripperSetting& value);

template <class T>
requires std::is_enum_v<T>
[[nodiscard]] std::string print_value(T value) {
  return std::string(choices(T{})[static_cast<std::size_t>(value)]);
}

template <class T>
[[nodiscard]] std::string print_value(const std::vector<T>& items) {
  std::string text;
  for (const T& item : items) text += (text.empty() ? "" : ", ") + print_value(item);
  return "[" + text + "]";
}

/// The doc with range and choices.
[[nodiscard]] std::string comment_of(const char* doc, const Range& range);

/// The visitor.
class FieldPrinter {
 public:
  explicit FieldPrinter(int depth = 0) : depth_(depth) {}

  template <class T>
  void operator()(const char* key, const T& value, const Range& range, const char* doc) {
    fields_.push_back({depth_, key, print_value(value), comment_of(doc, range)});
  }
  template <class T>
  void operator()(const char* key, const T& value, const char* doc) {
    fields_.push_back({depth_, key, "", doc});
    ++depth_;
    T::visit(value, *this);
    --depth_;
  }
  /// Structs in a list are printed by those who know what each starts from.
  template <class T>
  void operator()(const char* key, const std::vector<T>&, const char* doc) {
    fields_.push_back({depth_, key, "", doc});
  }

  [[nodiscard]] const std::vector<PrintedField>& fields() const { return fields_; }

 private:
  int depth_;
  std::vector<PrintedField> fields_;
};

template <class T>
[[nodiscard]] std::vector<PrintedField> print_fields(const T& value, int depth) {
  FieldPrinter printer(depth);
  T::visit(value, printer);
  return printer.fields();
}

/// What is different in `changed`, with the structs that it is in. Both are prints of the same struct.
[[nodiscard]] std::vector<PrintedField> difference(const std::vector<PrintedField>& base,
                                                   const std::vector<PrintedField>& changed);

/// YAML text; a comment that does not fit behind its key goes before it. A list item begins with a dash.
enum class YamlForm { kMap, kListItem };
[[nodiscard]] std::string to_yaml(const std::vector<PrintedField>& fields, YamlForm form = YamlForm::kMap);

}  // namespace graspd
