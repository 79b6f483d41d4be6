// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/table/parquet_reader.hpp"

#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "client/table/parquet_format.hpp"
#include "client/table/parquet_metadata.hpp"

namespace graspd {
namespace {

// What a table of ours stays far below: a group has 8 MB, or one row more.
constexpr std::int64_t kMostFooter = 64 << 20;
constexpr std::int64_t kMostGroup = 64 << 20;
constexpr std::int64_t kMostPageHeader = 1 << 16;

std::int64_t width(ColumnType type) {
  return type == ColumnType::kInt32 || type == ColumnType::kFloat ? 4 : 8;
}

}  // namespace

ParquetReader::ParquetReader(std::filesystem::path path, std::vector<Column> columns)
    : path_(std::move(path)), file_(path_, std::ios::binary), columns_(std::move(columns)) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path_, error);
  if (!file_ || error) fail("cannot be read");
  size_ = static_cast<std::int64_t>(size);
  constexpr std::int64_t kEnd = 8;
  if (size_ < kEnd + 4) fail("not a Parquet table");
  const std::string end = read(size_ - kEnd, kEnd);
  std::uint32_t footer = 0;
  std::memcpy(&footer, end.data(), sizeof footer);
  if (!end.ends_with(parquet::kMagic) || footer > kMostFooter || footer > size_ - kEnd - 4)
    fail("not a Parquet table");
  parse_footer(read(size_ - kEnd - footer, footer));
  group_ = groups_.size();
}

void ParquetReader::fail(const std::string& what) const {
  throw std::runtime_error(path_.string() + ": " + what);
}

std::string ParquetReader::read(std::int64_t offset, std::int64_t size) {
  if (offset < 0 || size < 0 || offset > size_ || size > size_ - offset) fail("not a whole Parquet table");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  file_.clear();
  file_.seekg(offset);
  if (!file_.read(bytes.data(), size)) fail("cannot be read");
  return bytes;
}

void ParquetReader::parse_footer(std::string_view footer) {
  const auto metadata = read_metadata(footer);
  if (!metadata) fail("not a Parquet table");
  std::vector<std::size_t> wanted;
  for (const Column& column : columns_) {
    const auto found = std::find(metadata->columns.begin(), metadata->columns.end(), column.name);
    if (found == metadata->columns.end())
      fail("has no column " + column.name + ": no table of graspd-replay");
    wanted.push_back(static_cast<std::size_t>(found - metadata->columns.begin()));
  }
  for (const ParquetMetadata::Group& found : metadata->groups) {
    Group group{rows_, found.rows, {}};
    if (found.rows <= 0 || found.rows > kMostGroup || found.chunks.size() != metadata->columns.size())
      fail("not a table of graspd-replay");
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const ParquetMetadata::Chunk& chunk = found.chunks[wanted[i]];
      if (chunk.type != static_cast<std::int64_t>(columns_[i].type))
        fail("column " + columns_[i].name + " is of another type: no table of graspd-replay");
      group.chunks.push_back({columns_[i].type, chunk.codec, chunk.offset, chunk.size});
    }
    rows_ += found.rows;
    groups_.push_back(std::move(group));
  }
  if (rows_ != metadata->rows) fail("not a whole Parquet table");
}

std::string ParquetReader::decompressed(const std::string& bytes, std::int64_t size) const {
  const auto said = static_cast<unsigned long long>(size);
  if (size > kMostGroup || ZSTD_getFrameContentSize(bytes.data(), bytes.size()) != said)
    fail("a page is damaged");
  std::string plain(static_cast<std::size_t>(size), '\0');
  const std::size_t got = ZSTD_decompress(plain.data(), plain.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(got) != 0U || got != plain.size()) fail("a page is damaged");
  return plain;
}

ParquetReader::Cells ParquetReader::read_chunk(const Group& group, const Chunk& chunk) {
  const std::string head = read(chunk.offset, std::min(chunk.size, kMostPageHeader));
  const auto page = read_page_header(head);
  if (!page || page->values != group.rows || page->encoding != parquet::kPlain)
    fail("not a table of graspd-replay");
  if (chunk.codec != parquet::kZstd && chunk.codec != parquet::kUncompressed)
    fail("compressed in another way than by graspd-replay");
  if (page->compressed > kMostGroup) fail("a page is too large");
  Cells cells{read(chunk.offset + page->header, page->compressed), {}};
  if (chunk.codec == parquet::kZstd) cells.bytes = decompressed(cells.bytes, page->uncompressed);
  if (chunk.type == ColumnType::kText) {
    cells.texts = starts_of_texts(cells.bytes, group.rows);
  } else if (std::ssize(cells.bytes) != group.rows * width(chunk.type)) {
    fail("a page is damaged");
  }
  return cells;
}

std::vector<std::size_t> ParquetReader::starts_of_texts(std::string_view bytes, std::int64_t rows) const {
  std::vector<std::size_t> starts;
  std::size_t at = 0;
  for (std::int64_t i = 0; i < rows; ++i) {
    std::uint32_t size = 0;
    if (bytes.size() - at < sizeof size) fail("a page is damaged");
    std::memcpy(&size, bytes.data() + at, sizeof size);
    if (bytes.size() - at - sizeof size < size) fail("a page is damaged");
    starts.push_back(at);
    at += sizeof size + size;
  }
  if (at != bytes.size()) fail("a page is damaged");
  return starts;
}

void ParquetReader::go_to(std::int64_t row) {
  if (row < 0 || row >= rows_) fail("has no row " + std::to_string(row));
  const auto after = std::upper_bound(groups_.begin(), groups_.end(), row,
                                      [](std::int64_t r, const Group& g) { return r < g.first_row; });
  const auto group = static_cast<std::size_t>(after - groups_.begin()) - 1;
  if (group != group_) {
    group_ = groups_.size();
    cells_.clear();
    std::int64_t bytes = 0;
    for (const Chunk& chunk : groups_[group].chunks) {
      cells_.push_back(read_chunk(groups_[group], chunk));
      bytes += std::ssize(cells_.back().bytes);
      if (bytes > kMostGroup) fail("a group of rows is too large");
    }
    group_ = group;
  }
  row_ = row - groups_[group].first_row;
}

template <class T>
T ParquetReader::cell(std::size_t column) const {
  T value{};
  std::memcpy(&value, cells_.at(column).bytes.data() + static_cast<std::size_t>(row_) * sizeof value,
              sizeof value);
  return value;
}

std::int64_t ParquetReader::integer(std::size_t column) const {
  return columns_.at(column).type == ColumnType::kInt32 ? cell<std::int32_t>(column)
                                                        : cell<std::int64_t>(column);
}

double ParquetReader::number(std::size_t column) const {
  return columns_.at(column).type == ColumnType::kFloat ? double{cell<float>(column)} : cell<double>(column);
}

std::string_view ParquetReader::text(std::size_t column) const {
  const Cells& cells = cells_.at(column);
  const std::size_t at = cells.texts.at(static_cast<std::size_t>(row_));
  std::uint32_t size = 0;
  std::memcpy(&size, cells.bytes.data() + at, sizeof size);
  return std::string_view(cells.bytes).substr(at + sizeof size, size);
}

bool is_parquet(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::ifstream file(path, std::ios::binary);
  std::string start(parquet::kMagic.size(), '\0');
  return file.read(start.data(), std::ssize(start)) && start == parquet::kMagic;
}

}  // namespace graspd
