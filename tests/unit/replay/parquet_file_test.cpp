// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/table/parquet_file.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "client/table/handle_tables.hpp"
#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

std::uint32_t footer_bytes(const std::string& file) {
  std::uint32_t size = 0;
  std::memcpy(&size, file.data() + file.size() - 8, 4);
  return size;
}

TEST(ParquetFile, HoldsPlainValuesBetweenItsMagics) {
  const TempFolder folder;
  ParquetFile table(folder / "t.parquet", {{"n", ColumnType::kInt32}, {"text", ColumnType::kText}});
  table.add(std::int64_t{7}).add(std::string_view("ab\xff"));
  table.end_row();
  EXPECT_FALSE(std::filesystem::exists(folder / "t.parquet"));
  table.finish();
  EXPECT_EQ(table.rows(), 1);
  const std::string bytes = read_bytes(folder / "t.parquet");
  EXPECT_TRUE(bytes.starts_with("PAR1"));
  EXPECT_TRUE(bytes.ends_with("PAR1"));
  EXPECT_LT(footer_bytes(bytes) + 12, bytes.size());
  EXPECT_NE(bytes.find(std::string("\x07\0\0\0", 4)), std::string::npos);
  EXPECT_NE(bytes.find(std::string("\x05\0\0\0ab\xef\xbf\xbd", 9)), std::string::npos)
      << "UTF-8 with its length";
}

TEST(ParquetFile, WhatIsNotFinishedLeavesNothing) {
  const TempFolder folder;
  { ParquetFile table(folder / "t.parquet", {{"n", ColumnType::kInt32}}); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_THROW(ParquetFile(folder / "no/t.parquet", {{"n", ColumnType::kInt32}}), std::runtime_error);
  EXPECT_THROW(ParquetFile("/dev/full/t", {{"n", ColumnType::kInt32}}), std::runtime_error);
}

TEST(HandleTables, TheFramesHaveAFileOfTheirOwn) {
  EXPECT_EQ(frames_table_path("a/b.parquet"), "a/b.frames.parquet");
  EXPECT_EQ(frames_table_path("b"), "b.frames.parquet");
}

}  // namespace
}  // namespace graspd
