// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/table/parquet_file.hpp"

#include <zstd.h>

#include <cassert>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "client/common/json_writer.hpp"
#include "client/table/compact_writer.hpp"
#include "client/table/parquet_format.hpp"

namespace graspd {
namespace {

using namespace parquet;

constexpr std::int64_t kGroupBytes = 8 << 20;
constexpr int kCompressionLevel = 3;

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append_number(std::string& cells, ColumnType type, auto value) {
  switch (type) {
    case ColumnType::kInt32:
      return append(cells, static_cast<std::int32_t>(value));
    case ColumnType::kInt64:
      return append(cells, static_cast<std::int64_t>(value));
    case ColumnType::kFloat:
      return append(cells, static_cast<float>(value));
    case ColumnType::kDouble:
      return append(cells, static_cast<double>(value));
    case ColumnType::kText:
      assert(false && "a number in a column of text");
  }
}

std::string compressed(const std::string& bytes) {
  std::string result(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(result.data(), result.size(), bytes.data(), bytes.size(), kCompressionLevel);
  if (ZSTD_isError(size) != 0U) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(size));
  result.resize(size);
  return result;
}

std::string page_header(std::size_t bytes, std::size_t compressed, std::int64_t values) {
  CompactWriter w;
  w.begin_struct();
  w.i32(1, kDataPage);
  w.i32(2, static_cast<std::int32_t>(bytes));
  w.i32(3, static_cast<std::int32_t>(compressed));
  w.begin_struct(5);
  w.i32(1, static_cast<std::int32_t>(values));
  w.i32(2, kPlain);
  w.i32(3, kRle);
  w.i32(4, kRle);
  w.end_struct();
  w.end_struct();
  return w.bytes();
}

}  // namespace

ParquetFile::ParquetFile(std::filesystem::path path, std::vector<Column> columns)
    : path_(std::move(path)),
      beside_(path_.string() + ".part"),
      file_(beside_, std::ios::binary),
      columns_(std::move(columns)),
      cells_(columns_.size()) {
  write(kMagic);
}

ParquetFile::~ParquetFile() {
  std::error_code error;
  if (file_.is_open()) std::filesystem::remove(beside_, error);
}

void ParquetFile::write(std::string_view bytes) {
  file_.write(bytes.data(), std::ssize(bytes));
  if (!file_) throw std::runtime_error(path_.string() + ": cannot be written");
  offset_ += std::ssize(bytes);
}

ColumnType ParquetFile::next_type() {
  assert(next_ < columns_.size());
  return columns_[next_++].type;
}

ParquetFile& ParquetFile::add(std::int64_t value) {
  const ColumnType type = next_type();
  append_number(cells_[next_ - 1], type, value);
  return *this;
}

ParquetFile& ParquetFile::add(double value) {
  const ColumnType type = next_type();
  append_number(cells_[next_ - 1], type, value);
  return *this;
}

ParquetFile& ParquetFile::add(std::string_view value) {
  const ColumnType type = next_type();
  assert(type == ColumnType::kText);
  (void)type;
  const std::string text = valid_utf8(value);
  append(cells_[next_ - 1], static_cast<std::uint32_t>(text.size()));
  cells_[next_ - 1] += text;
  bytes_in_group_ += std::ssize(text);
  return *this;
}

void ParquetFile::end_row() {
  assert(next_ == columns_.size());
  next_ = 0;
  ++rows_in_group_;
  bytes_in_group_ += 8 * std::ssize(columns_);
  if (bytes_in_group_ >= kGroupBytes) write_group();
}

void ParquetFile::write_group() {
  if (rows_in_group_ == 0) return;
  Group group;
  group.rows = rows_in_group_;
  for (std::string& cells : cells_) {
    const std::int64_t start = offset_;
    const std::string page = compressed(cells);
    const std::string header = page_header(cells.size(), page.size(), rows_in_group_);
    write(header);
    write(page);
    group.chunks.push_back({start, offset_ - start, std::ssize(header) + std::ssize(cells)});
    cells.clear();
  }
  groups_.push_back(std::move(group));
  rows_ += rows_in_group_;
  rows_in_group_ = 0;
  bytes_in_group_ = 0;
}

std::string ParquetFile::footer() const {
  CompactWriter w;
  w.begin_struct();
  w.i32(1, 1);  // version
  w.structs(2, columns_.size() + 1);
  w.begin_struct();
  w.text(4, "schema");
  w.i32(5, static_cast<std::int32_t>(columns_.size()));
  w.end_struct();
  for (const Column& column : columns_) {
    w.begin_struct();
    w.i32(1, static_cast<std::int32_t>(column.type));
    w.i32(3, kRequired);
    w.text(4, column.name);
    if (column.type == ColumnType::kText) w.i32(6, kUtf8);
    w.end_struct();
  }
  w.i64(3, rows_);
  w.structs(4, groups_.size());
  for (const Group& group : groups_) {
    w.begin_struct();
    w.structs(1, columns_.size());
    std::int64_t group_bytes = 0;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Chunk& chunk = group.chunks[i];
      group_bytes += chunk.uncompressed;
      w.begin_struct();
      w.i64(2, chunk.offset);
      w.begin_struct(3);
      w.i32(1, static_cast<std::int32_t>(columns_[i].type));
      w.i32s(2, {kPlain});
      w.texts(3, {columns_[i].name});
      w.i32(4, kZstd);
      w.i64(5, group.rows);
      w.i64(6, chunk.uncompressed);
      w.i64(7, chunk.size);
      w.i64(9, chunk.offset);
      w.end_struct();
      w.end_struct();
    }
    w.i64(2, group_bytes);
    w.i64(3, group.rows);
    w.end_struct();
  }
  w.text(6, "graspd");
  w.end_struct();
  return w.bytes();
}

void ParquetFile::finish() {
  write_group();
  const std::string text = footer();
  write(text);
  std::string length;
  append(length, static_cast<std::uint32_t>(text.size()));
  write(length);
  write(kMagic);
  file_.close();
  if (!file_) throw std::runtime_error(path_.string() + ": cannot be written");
  std::filesystem::rename(beside_, path_);
}

}  // namespace graspd
