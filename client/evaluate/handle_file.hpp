// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// CSV files in: handles as graspd-detect and graspd-listen write them, and lists of objects and categories.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory_resource>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "service/pipeline/handle.hpp"

namespace graspd {

/// A table file that cannot be used; what() is one line: `path:line: reason`.
class CsvError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Columns are found by their names in the first line; cells may be quoted as RFC 4180 has it.
class CsvFile {
 public:
  /// Throws CsvError where the file cannot be read, has no such column, or has rows of another length.
  CsvFile(std::filesystem::path path, const std::vector<std::string>& needed);

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] bool has(std::string_view column) const { return columns_.contains(std::string(column)); }
  [[nodiscard]] const std::string& text(std::size_t row, const std::string& column) const;
  /// Throw CsvError where the cell is no such number.
  [[nodiscard]] float number(std::size_t row, const std::string& column) const;
  [[nodiscard]] std::int64_t integer(std::size_t row, const std::string& column) const;
  /// Throws CsvError that names the row's line.
  [[noreturn]] void fail(std::size_t row, const std::string& reason) const;

 private:
  std::filesystem::path path_;
  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<std::size_t> lines_;  // of each row, from 1
};

/// Handles of each frame in the order of the file, best first.
struct HandleFile {
  std::map<std::string, std::pmr::vector<Handle>> by_frame;  ///< by the column `frame`
  std::map<std::int64_t, std::pmr::vector<Handle>> by_seq;   ///< by the column `seq`, where there is one
  [[nodiscard]] const std::pmr::vector<Handle>* find(const std::string& frame) const;
  [[nodiscard]] const std::pmr::vector<Handle>* find(std::int64_t seq) const;
};

/// Needs frame, px, py, pz, qw, qx, qy, qz, width; takes score and seq along. Rows with id -1 stand for
/// lists without handles. Throws CsvError.
[[nodiscard]] HandleFile read_handle_file(const std::filesystem::path& path);

/// Objects of each frame that can be held at all: rows of frame, object, poses with at least min_poses.
[[nodiscard]] std::map<std::string, std::set<int>> read_graspable_file(const std::filesystem::path& path,
                                                                       int min_poses = 3);

/// Category of each frame: rows of frame, category.
[[nodiscard]] std::map<std::string, std::string> read_category_file(const std::filesystem::path& path);

}  // namespace graspd
