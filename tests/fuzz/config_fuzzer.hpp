// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What must hold of whatever a configuration reader makes of any bytes.
#pragma once
#include <algorithm>
#include <string_view>

#include "service/config/config_error.hpp"
#include "tests/fuzz/scratch_file.hpp"

namespace graspd {

/// A file is used, or refused with one line.
template <class Load>
void check_config(const std::uint8_t* data, std::size_t size, const Load& load) {
  try {
    load(scratch_file(data, size));
  } catch (const ConfigError& error) {
    const std::string_view text = error.what();
    require(!text.empty() &&
            std::none_of(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\0'; }));
  }
}

}  // namespace graspd
