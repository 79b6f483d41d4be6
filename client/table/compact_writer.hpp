// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Thrift's compact protocol, as far as a Parquet file's headers need it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace graspd {

/// Fields of a struct are written in the order of their ids; the caller ends what it begins.
class CompactWriter {
 public:
  void i32(int id, std::int32_t value);
  void i64(int id, std::int64_t value);
  void text(int id, std::string_view value);
  void begin_struct(int id);
  /// A struct as an element of a list, or the outermost one.
  void begin_struct() { last_ids_.push_back(0); }
  void end_struct();
  void structs(int id, std::size_t count) { list(id, kStruct, count); }  ///< begin_struct() for each follows
  void i32s(int id, const std::vector<std::int32_t>& values);
  void texts(int id, const std::vector<std::string>& values);

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  enum Type : unsigned { kI32 = 5, kI64 = 6, kBinary = 8, kList = 9, kStruct = 12 };

  void field(int id, Type type);
  void list(int id, Type type, std::size_t count);
  void varint(std::uint64_t value);
  void zigzag(std::int64_t value);
  void binary(std::string_view value);

  std::string bytes_;
  std::vector<int> last_ids_;  // of each open struct
};

}  // namespace graspd
