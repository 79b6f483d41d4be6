// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/config_error.hpp"

namespace graspd {

ConfigPlace ConfigPlace::child(const std::string& name) const {
  return {file, key.empty() ? name : key + "." + name};
}

ConfigPlace ConfigPlace::item(std::size_t index) const {
  return {file, key + "[" + std::to_string(index) + "]"};
}

void ConfigPlace::fail(const std::string& reason, const std::string& got, const std::string& expected) const {
  std::string line = file + ": ";
  if (!key.empty()) line += key + ": ";
  line += reason;
  if (!got.empty() || !expected.empty()) {
    line += " (";
    if (!got.empty()) line += "got " + got;
    if (!got.empty() && !expected.empty()) line += ", ";
    if (!expected.empty()) line += "expected " + expected;
    line += ")";
  }
  throw ConfigError(line);
}

}  // namespace graspd
