// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/config/config_error_text.hpp"

#include "service/config/config_error.hpp"

namespace graspd {

std::string config_error(const std::filesystem::path& file, const std::function<void()>& call) {
  try {
    call();
  } catch (const ConfigError& e) {
    const std::string line = e.what();
    const std::string start = file.string() + ": ";
    return line.starts_with(start) ? line.substr(start.size()) : "NOT NAMING THE FILE: " + line;
  }
  return "";
}

}  // namespace graspd
