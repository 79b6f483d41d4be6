// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The one error of the configuration layer, and the place in a file that it names.
#pragma once
#include <cstddef>
#include <stdexcept>
#include <string>

namespace graspd {

/// A configuration that cannot be used. what() is one line: `file: a.b.c: reason (got X, expected Y)`.
/// Programs print it and exit with 2.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A value's place: the file, and the keys that lead to it (empty: the whole file).
struct ConfigPlace {
  std::string file;
  std::string key;

  [[nodiscard]] ConfigPlace child(const std::string& name) const;
  [[nodiscard]] ConfigPlace item(std::size_t index) const;

  /// Throws ConfigError; `got` and `expected` are left out where empty.
  [[noreturn]] void fail(const std::string& reason, const std::string& got,
                         const std::string& expected) const;
};

}  // namespace graspd
