// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Tables of a run as the handle lists that they were made from.
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "client/table/parquet_reader.hpp"
#include "graspd/handle_list_t.hpp"

namespace graspd {

/// Reads what HandleTables has written: FILE.parquet and FILE.frames.parquet. Takes memory for a group of
/// rows of each, and 8 bytes a frame. Throws std::runtime_error that names the file for what is no such pair
/// of tables.
class HandleTablesReader {
 public:
  explicit HandleTablesReader(const std::filesystem::path& file);

  [[nodiscard]] std::int64_t frames() const { return frames_.rows(); }

  /// The list of a frame. Numbers of handles are as exact as a float; of the stages there is one, with the
  /// time of all; the counts of failures by reason are left out.
  [[nodiscard]] handle_list_t list(std::int64_t frame);

 private:
  [[nodiscard]] handle_t handle(std::int64_t row, std::int64_t frame);

  std::filesystem::path file_;
  ParquetReader handles_;
  ParquetReader frames_;
  std::vector<std::int64_t> first_handles_;  // row of each frame's first handle, and one past the last
};

/// Numbers of handles as a table holds them.
void round_as_in_tables(handle_list_t& list);

}  // namespace graspd
