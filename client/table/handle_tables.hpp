// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Logs of handle lists as two tables: a row a handle, a row a frame.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "client/table/parquet_file.hpp"
#include "graspd/handle_list_t.hpp"

namespace graspd {

/// FILE.parquet holds the handles, FILE.frames.parquet the frames; `frame`, counted from 0, joins them.
class HandleTables {
 public:
  explicit HandleTables(const std::filesystem::path& file);

  /// `recv_utime`: when it was recorded [us] since 1970.
  void add(std::int64_t recv_utime, std::string_view channel, const handle_list_t& list);
  void finish();

  [[nodiscard]] std::int64_t frames() const { return frames_.rows(); }
  [[nodiscard]] std::int64_t handles() const { return handles_.rows(); }

 private:
  ParquetFile handles_;
  ParquetFile frames_;
};

/// results.parquet -> results.frames.parquet.
[[nodiscard]] std::filesystem::path frames_table_path(const std::filesystem::path& file);

/// Every valid handle list of a log, in order, into tables; what is none is passed over. Throws
/// EventLogError, std::runtime_error. Returns how many lists there were.
std::int64_t write_tables(const std::filesystem::path& log, const std::filesystem::path& file);

}  // namespace graspd
