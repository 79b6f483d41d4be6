// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Reads YAML maps into configuration structs by their visit(), strictly.
#pragma once
#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "service/config/config_error.hpp"
#include "service/config/source_config.hpp"
#include "service/pipeline/config_fields.hpp"

namespace graspd {

/// Lists a struct's keys.
struct KeyCollector {
  std::vector<std::string> keys;
  template <class... Rest>
  void operator()(const char* key, const Rest&...) {
    keys.emplace_back(key);
  }
};

template <class T>
[[nodiscard]] std::vector<std::string> keys_of(const T& value) {
  KeyCollector collector;
  T::visit(value, collector);
  return collector.keys;
}

/// Throws unless the node is a map or absent, of known keys, none of them twice, with those that are
/// required.
void check_map(const YAML::Node& map, const ConfigPlace& place, const std::vector<std::string>& known,
               std::span<const std::string> required);

/// Throws what a struct's validate() says. A reason of the form "why: expected what" is taken apart.
[[noreturn]] void fail_validation(const ConfigProblem& problem, const YAML::Node& map,
                                  const ConfigPlace& place);

/// What a node is, for messages: the scalar's text, or "a list of 3", "a map", "nothing".
[[nodiscard]] std::string describe(const YAML::Node& node);

/// The value under the key; invalid (false) when there is none. Unlike operator[] it leaves the tree as it
/// is.
[[nodiscard]] YAML::Node find(const YAML::Node& map, const std::string& key);

void read_value(const YAML::Node& node, const ConfigPlace& place, const Range& range, bool& value);
void read_value(const YAML::Node& node, const ConfigPlace& place, const Range& range, double& value);
void read_value(const YAML::Node& node, const ConfigPlace& place, const Range& range, float& value);
void read_value(const YAML::Node& node, const ConfigPlace& place, const Range& range, std::int64_t& value);
void read_value(const YAML::Node& node, const ConfigPlace& place, const Range& range, int& value);
void read_value(const YAML::Node& node, const ConfigPlace& place, const Range& range, std::string& value);
void read_value(const YAML::Node& node, const ConfigPlace& place, const Range& range, Eigen::Vector3f& value);
void read_value(const YAML::Node& node, const ConfigPlace& place, const Range& range, GripperSetting& value);
/// The index of the text among the names.
[[nodiscard]] std::size_t read_choice(const YAML::Node& node, const ConfigPlace& place,
                                      std::span<const std::string_view> names);
/// Throws unless the node is a list; its length.
[[nodiscard]] std::size_t list_length(const YAML::Node& node, const ConfigPlace& place);

template <class T>
requires std::is_enum_v<T>
void read_value(const YAML::Node& node, const ConfigPlace& place, const Range&, T& value) {
  value = static_cast<T>(read_choice(node, place, choices(T{})));
}

template <class T>
void read_value(const YAML::Node& node, const ConfigPlace& place, const Range& range, std::vector<T>& value) {
  std::vector<T> items(list_length(node, place));
  for (std::size_t i = 0; i < items.size(); ++i) read_value(node[i], place.item(i), range, items[i]);
  value = std::move(items);
}

/// The visitor. Keys that are missing keep what the struct holds.
class FieldReader {
 public:
  FieldReader(const YAML::Node& map, ConfigPlace place) : map_(map), place_(std::move(place)) {}

  /// A value.
  template <class T>
  void operator()(const char* key, T& value, const Range& range, const char*) {
    if (const YAML::Node node = find(map_, key)) read_value(node, place_.child(key), range, value);
  }
  /// A nested struct.
  template <class T>
  void operator()(const char* key, T& value, const char*);
  /// Structs in a list are read by those who know what each starts from.
  template <class T>
  void operator()(const char*, std::vector<T>&, const char*) {}

 private:
  YAML::Node map_;
  ConfigPlace place_;
};

/// Reads a map over what the struct holds, then checks the rules between its fields.
template <class T>
void read_struct(const YAML::Node& map, const ConfigPlace& place, T& value,
                 std::span<const std::string> required = {}) {
  check_map(map, place, keys_of(value), required);
  FieldReader reader(map, place);
  T::visit(value, reader);
  if constexpr (requires { value.validate(); }) {
    if (const auto problem = value.validate()) fail_validation(*problem, map, place);
  }
}

template <class T>
void FieldReader::operator()(const char* key, T& value, const char*) {
  // Absent ones are visited too: the rules hold between fields of an overlay and what it lies on.
  read_struct(find(map_, key), place_.child(key), value);
}

}  // namespace graspd
