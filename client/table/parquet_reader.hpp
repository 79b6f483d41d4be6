// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Reads the Parquet tables that ParquetFile writes.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "client/table/parquet_file.hpp"

namespace graspd {

/// Any row by its number; rows near each other are read together. Takes memory for one group of rows. What is
/// not such a table is refused, whatever its bytes: every member throws std::runtime_error that names the
/// file.
class ParquetReader {
 public:
  /// The columns that are wanted, of any that the table has.
  ParquetReader(std::filesystem::path path, std::vector<Column> columns);

  [[nodiscard]] std::int64_t rows() const { return rows_; }

  /// Whose cells are given from now on.
  void go_to(std::int64_t row);

  /// Of the wanted column with this index; kInt32 or kInt64, kFloat or kDouble, kText.
  [[nodiscard]] std::int64_t integer(std::size_t column) const;
  [[nodiscard]] double number(std::size_t column) const;
  [[nodiscard]] std::string_view text(std::size_t column) const;

 private:
  struct Chunk {
    ColumnType type = ColumnType::kInt64;
    std::int64_t codec = 0;
    std::int64_t offset = 0;
    std::int64_t size = 0;
  };
  struct Group {
    std::int64_t first_row = 0;
    std::int64_t rows = 0;
    std::vector<Chunk> chunks;  // of the wanted columns
  };
  struct Cells {
    std::string bytes;
    std::vector<std::size_t> texts;  // where each text's length begins, of columns of text
  };

  [[noreturn]] void fail(const std::string& what) const;
  [[nodiscard]] std::string read(std::int64_t offset, std::int64_t size);
  void parse_footer(std::string_view footer);
  [[nodiscard]] Cells read_chunk(const Group& group, const Chunk& chunk);
  [[nodiscard]] std::string decompressed(const std::string& bytes, std::int64_t size) const;
  [[nodiscard]] std::vector<std::size_t> starts_of_texts(std::string_view bytes, std::int64_t rows) const;
  template <class T>
  [[nodiscard]] T cell(std::size_t column) const;

  std::filesystem::path path_;
  std::ifstream file_;
  std::int64_t size_ = 0;
  std::vector<Column> columns_;
  std::vector<Group> groups_;
  std::int64_t rows_ = 0;
  std::size_t group_ = 0;  // whose cells are there; none: groups_.size()
  std::vector<Cells> cells_;
  std::int64_t row_ = 0;  // in the group
};

/// Whether the file starts as a Parquet file does.
[[nodiscard]] bool is_parquet(const std::filesystem::path& path);

}  // namespace graspd
