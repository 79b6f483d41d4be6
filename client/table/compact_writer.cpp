// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/table/compact_writer.hpp"

namespace graspd {

void CompactWriter::i32(int id, std::int32_t value) {
  field(id, kI32);
  zigzag(value);
}

void CompactWriter::i64(int id, std::int64_t value) {
  field(id, kI64);
  zigzag(value);
}

void CompactWriter::text(int id, std::string_view value) {
  field(id, kBinary);
  binary(value);
}

void CompactWriter::begin_struct(int id) {
  field(id, kStruct);
  begin_struct();
}

void CompactWriter::end_struct() {
  bytes_ += '\0';
  last_ids_.pop_back();
}

void CompactWriter::i32s(int id, const std::vector<std::int32_t>& values) {
  list(id, kI32, values.size());
  for (const std::int32_t value : values) zigzag(value);
}

void CompactWriter::texts(int id, const std::vector<std::string>& values) {
  list(id, kBinary, values.size());
  for (const std::string& value : values) binary(value);
}

void CompactWriter::field(int id, Type type) {
  // Ids go up by less than 16 in every struct of Parquet.
  const int delta = id - last_ids_.back();
  bytes_ += static_cast<char>((static_cast<unsigned>(delta) << 4) | type);
  last_ids_.back() = id;
}

void CompactWriter::list(int id, Type type, std::size_t count) {
  field(id, kList);
  if (count < 15) {
    bytes_ += static_cast<char>((count << 4) | type);
  } else {
    bytes_ += static_cast<char>(0xf0U | type);
    varint(count);
  }
}

void CompactWriter::varint(std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes_ += static_cast<char>((value & 0x7f) | 0x80);
  bytes_ += static_cast<char>(value);
}

void CompactWriter::zigzag(std::int64_t value) {
  varint((static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63));
}

void CompactWriter::binary(std::string_view value) {
  varint(value.size());
  bytes_ += value;
}

}  // namespace graspd
