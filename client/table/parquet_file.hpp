// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes tables as Parquet files: plain values, compressed by zstd, no missing ones. Own code, because Debian
// 12 has no library that does; pyarrow, DuckDB and pandas read them (tests/table/run).
#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace graspd {

/// The types of a column, with Parquet's numbers.
enum class ColumnType : std::int32_t { kInt32 = 1, kInt64 = 2, kFloat = 4, kDouble = 5, kText = 6 };

struct Column {
  std::string name;
  ColumnType type = ColumnType::kInt64;
};

/// Rows are written in groups, so memory does not grow with the table. The file has its name from finish()
/// on.
class ParquetFile {
 public:
  /// Throws std::runtime_error that names the file, as the rest does.
  ParquetFile(std::filesystem::path path, std::vector<Column> columns);
  ~ParquetFile();  ///< Removes what was not finished.
  ParquetFile(const ParquetFile&) = delete;
  ParquetFile& operator=(const ParquetFile&) = delete;

  /// The next cells of the row, in the order of the columns. A number becomes what its column holds; a text
  /// that is not UTF-8 gets question marks.
  ParquetFile& add(std::int64_t value);
  ParquetFile& add(double value);
  ParquetFile& add(std::string_view value);
  void end_row();

  void finish();
  [[nodiscard]] std::int64_t rows() const { return rows_ + rows_in_group_; }

 private:
  struct Chunk {
    std::int64_t offset = 0;  ///< of its page header [bytes]
    std::int64_t size = 0;    ///< with the header [bytes]
    std::int64_t uncompressed = 0;
  };
  struct Group {
    std::vector<Chunk> chunks;
    std::int64_t rows = 0;
  };

  ColumnType next_type();
  void write_group();
  void write(std::string_view bytes);
  [[nodiscard]] std::string footer() const;

  std::filesystem::path path_;
  std::filesystem::path beside_;
  std::ofstream file_;
  std::vector<Column> columns_;
  std::vector<std::string> cells_;  // of the group that is filled, column by column
  std::size_t next_ = 0;            // column of the row that is filled
  std::int64_t rows_in_group_ = 0;
  std::int64_t bytes_in_group_ = 0;
  std::int64_t offset_ = 0;
  std::int64_t rows_ = 0;
  std::vector<Group> groups_;
};

}  // namespace graspd
