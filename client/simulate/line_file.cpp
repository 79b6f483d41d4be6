// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/line_file.hpp"

#include <stdexcept>

namespace graspd {

LineFile::LineFile(const std::string& path) : path_(path), out_(path, std::ios::trunc) {
  check();
}

void LineFile::write(const std::string& line) {
  out_ << line << std::flush;
  check();
}

void LineFile::check() const {
  if (!out_) throw std::runtime_error(path_ + ": cannot be written");
}

}  // namespace graspd
