// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/table/parquet_file.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "client/table/handle_tables.hpp"
#include "client/table/parquet_reader.hpp"
#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

std::uint32_t footer_bytes(const std::string& file) {
  std::uint32_t size = 0;
  std::memcpy(&size, file.data() + file.size() - 8, 4);
  return size;
}

const std::vector<Column> kEveryType{{"i", ColumnType::kInt32},
                                     {"l", ColumnType::kInt64},
                                     {"f", ColumnType::kFloat},
                                     {"d", ColumnType::kDouble},
                                     {"t", ColumnType::kText}};

TEST(ParquetFile, GivesBackWhatWasWritten) {
  const TempFolder folder;
  // Some groups of rows.
  constexpr std::int64_t kRows = 300'000;
  ParquetFile table(folder / "t.parquet", kEveryType);
  const auto text_of = [](std::int64_t row) { return std::string(static_cast<std::size_t>(row % 40), 'x'); };
  for (std::int64_t row = 0; row < kRows; ++row) {
    table.add(-row).add(row << 32).add(0.1 * static_cast<double>(row)).add(0.1 * static_cast<double>(row));
    table.add(std::string_view(text_of(row)));
    table.end_row();
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "t.parquet"));
  table.finish();
  EXPECT_EQ(table.rows(), kRows);
  ParquetReader reader(folder / "t.parquet", kEveryType);
  ASSERT_EQ(reader.rows(), kRows);
  for (const std::int64_t row :
       {std::int64_t{0}, std::int64_t{1}, kRows / 2, kRows - 1, std::int64_t{77'777}}) {
    reader.go_to(row);
    EXPECT_EQ(reader.integer(0), -row);
    EXPECT_EQ(reader.integer(1), row << 32);
    EXPECT_EQ(reader.number(2), static_cast<float>(0.1 * static_cast<double>(row)));
    EXPECT_EQ(reader.number(3), 0.1 * static_cast<double>(row));
    EXPECT_EQ(reader.text(4), text_of(row));
  }
  EXPECT_THROW(reader.go_to(kRows), std::runtime_error);
  EXPECT_THROW(reader.go_to(-1), std::runtime_error);
}

TEST(ParquetFile, AnyColumnsInAnyOrderCanBeRead) {
  const TempFolder folder;
  ParquetFile table(folder / "t.parquet", kEveryType);
  table.add(std::int64_t{1}).add(std::int64_t{2}).add(3.5).add(4.5).add(std::string_view("ab\xff"));
  table.end_row();
  table.finish();
  ParquetReader reader(folder / "t.parquet", {{"t", ColumnType::kText}, {"l", ColumnType::kInt64}});
  reader.go_to(0);
  EXPECT_EQ(reader.text(0), "ab\xef\xbf\xbd");
  EXPECT_EQ(reader.integer(1), 2);
  EXPECT_THROW(ParquetReader(folder / "t.parquet", {{"none", ColumnType::kText}}), std::runtime_error);
  EXPECT_THROW(ParquetReader(folder / "t.parquet", {{"l", ColumnType::kText}}), std::runtime_error);
}

TEST(ParquetFile, HasItsMagicsAndALengthAtTheEnd) {
  const TempFolder folder;
  ParquetFile table(folder / "t.parquet", {{"n", ColumnType::kInt32}});
  table.finish();
  const std::string bytes = read_bytes(folder / "t.parquet");
  EXPECT_TRUE(bytes.starts_with("PAR1"));
  EXPECT_TRUE(bytes.ends_with("PAR1"));
  EXPECT_EQ(footer_bytes(bytes) + 12, bytes.size()) << "no rows, no pages";
  EXPECT_EQ(ParquetReader(folder / "t.parquet", {{"n", ColumnType::kInt32}}).rows(), 0);
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
