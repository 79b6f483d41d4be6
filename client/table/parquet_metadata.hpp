// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a Parquet file says of itself, as far as flat tables without missing values need it.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace graspd {

/// As the file has it: nothing here is checked against the file.
struct ParquetMetadata {
  struct Chunk {
    std::int64_t type = -1;
    std::int64_t codec = -1;
    std::int64_t offset = -1;  ///< of its page header [bytes]
    std::int64_t size = -1;    ///< with the header [bytes]
  };
  struct Group {
    std::vector<Chunk> chunks;  ///< in the order of the columns
    std::int64_t rows = 0;
  };
  std::vector<std::string> columns;
  std::vector<Group> groups;
  std::int64_t rows = 0;
};

/// Nothing for what is no footer, or of a table with nested or optional columns.
[[nodiscard]] std::optional<ParquetMetadata> read_metadata(std::string_view footer);

struct PageHeader {
  std::int64_t header = 0;        ///< of itself [bytes]
  std::int64_t uncompressed = 0;  ///< of what follows [bytes]
  std::int64_t compressed = 0;
  std::int64_t values = 0;
  std::int64_t encoding = -1;
};

/// Nothing for what is no data page's header.
[[nodiscard]] std::optional<PageHeader> read_page_header(std::string_view bytes);

}  // namespace graspd
