// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "client/table/parquet_reader.hpp"
#include "tests/fuzz/scratch_file.hpp"

/// Every cell of a table that is taken can be read.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using graspd::ColumnType;
  const auto file = graspd::scratch_file(data, size);
  try {
    graspd::ParquetReader reader(file, {{"number", ColumnType::kInt64}, {"text", ColumnType::kText}});
    for (std::int64_t row = 0; row < reader.rows(); ++row) {
      reader.go_to(row);
      (void)reader.integer(0);
      (void)reader.text(1);
    }
  } catch (const std::runtime_error&) {
  }
  return 0;
}
