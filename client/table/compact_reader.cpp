// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/table/compact_reader.hpp"

namespace graspd {
namespace {

constexpr int kDeepest = 16;

}  // namespace

void CompactReader::fail() {
  ok_ = false;
  at_ = bytes_.size();
}

unsigned CompactReader::byte() {
  if (at_ >= bytes_.size()) {
    fail();
    return 0;
  }
  return static_cast<unsigned char>(bytes_[at_++]);
}

std::uint64_t CompactReader::varint() {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    const unsigned next = byte();
    value |= static_cast<std::uint64_t>(next & 0x7fU) << shift;
    if ((next & 0x80U) == 0) return ok_ ? value : 0;
  }
  fail();
  return 0;
}

void CompactReader::advance(std::uint64_t bytes) {
  if (bytes > bytes_.size() - at_) return fail();
  at_ += bytes;
}

std::int64_t CompactReader::integer() {
  const std::uint64_t value = varint();
  return static_cast<std::int64_t>((value >> 1) ^ (~(value & 1) + 1));
}

std::string_view CompactReader::binary() {
  const std::uint64_t size = varint();
  const std::size_t begin = at_;
  advance(size);
  return ok_ ? bytes_.substr(begin, size) : std::string_view();
}

bool CompactReader::field(Field& field) {
  const unsigned head = byte();
  field.type = head & 0xfU;
  if (!ok_ || field.type == kStop) {
    if (!last_ids_.empty()) last_ids_.pop_back();
    return false;
  }
  const unsigned delta = head >> 4;
  field.id = delta != 0 ? last_ids_.back() + delta : integer();
  last_ids_.back() = field.id;
  return ok_;
}

std::uint64_t CompactReader::list_head(unsigned& type) {
  const unsigned head = byte();
  type = head & 0xfU;
  const std::uint64_t count = (head >> 4) == 0xfU ? varint() : head >> 4;
  // Every element takes a byte at least.
  if (count > bytes_.size() - at_) fail();
  return ok_ ? count : 0;
}

std::size_t CompactReader::list(Type type) {
  unsigned found = kStop;
  const std::uint64_t count = list_head(found);
  if (found == type || count == 0) return count;
  fail();
  return 0;
}

void CompactReader::skip_fields(int depth) {
  begin_struct();
  for (Field f; field(f);) skip(f.type, depth);
}

void CompactReader::skip(unsigned type, int depth) {
  if (depth > kDeepest) return fail();
  switch (type) {
    case kTrue:
    case kFalse:
      return;
    case kByte:
      return advance(1);
    case kI16:
    case kI32:
    case kI64:
      (void)varint();
      return;
    case kDouble:
      return advance(8);
    case kBinary:
      (void)binary();
      return;
    case kStruct:
      return skip_fields(depth + 1);
    case kList:
    case kSet: {
      unsigned element = kStop;
      // A list's booleans are bytes.
      for (std::uint64_t left = list_head(element); left > 0 && ok_; --left)
        skip(element == kTrue || element == kFalse ? unsigned{kByte} : element, depth + 1);
      return;
    }
    default:  // maps, which Parquet does not have
      return fail();
  }
}

}  // namespace graspd
