// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A file of lines that others read while it grows.
#pragma once
#include <fstream>
#include <string>

namespace graspd {

/// Each line is complete at once. Throws std::runtime_error that names the file when it cannot be written.
class LineFile {
 public:
  explicit LineFile(const std::string& path);
  /// line: with its end.
  void write(const std::string& line);

 private:
  void check() const;

  std::string path_;
  std::ofstream out_;
};

}  // namespace graspd
