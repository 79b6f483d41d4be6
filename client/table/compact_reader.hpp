// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Thrift's compact protocol, read as far as a Parquet file's headers need it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace graspd {

/// Reads strangers' bytes: after the first that cannot be, ok() is false and every value 0.
class CompactReader {
 public:
  explicit CompactReader(std::string_view bytes) : bytes_(bytes) {}

  enum Type : unsigned {
    kStop = 0,
    kTrue = 1,
    kFalse = 2,
    kByte = 3,
    kI16 = 4,
    kI32 = 5,
    kI64 = 6,
    kDouble = 7,
    kBinary = 8,
    kList = 9,
    kSet = 10,
    kMap = 11,
    kStruct = 12
  };
  struct Field {
    std::int64_t id = 0;
    unsigned type = kStop;
    /// Which of them it is, where it has the type that it must have.
    [[nodiscard]] bool is(std::int64_t wanted, Type of_type) const { return id == wanted && type == of_type; }
  };

  /// Begins a struct; fields follow until field() is false, and what is not read of them is skipped.
  void begin_struct() { last_ids_.push_back(0); }
  [[nodiscard]] bool field(Field& field);
  void skip(const Field& field) { skip(field.type, 0); }

  [[nodiscard]] std::int64_t integer();
  [[nodiscard]] std::string_view binary();
  /// Elements of a list that all have the type; a list of another type is skipped, with 0.
  [[nodiscard]] std::size_t list(Type type);

  [[nodiscard]] bool ok() const { return ok_; }
  /// What is behind the last value.
  [[nodiscard]] std::size_t position() const { return at_; }

 private:
  void fail();
  unsigned byte();
  std::uint64_t varint();
  void advance(std::uint64_t bytes);
  void skip(unsigned type, int depth);
  void skip_fields(int depth);
  std::uint64_t list_head(unsigned& type);

  std::string_view bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
  std::vector<std::int64_t> last_ids_;  // of each open struct
};

}  // namespace graspd
