// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/table/parquet_metadata.hpp"

#include "client/table/compact_reader.hpp"
#include "client/table/parquet_format.hpp"

namespace graspd {
namespace {

using Field = CompactReader::Field;
using enum CompactReader::Type;

struct SchemaElement {
  std::string name;
  std::int64_t repetition = parquet::kRequired;
  std::int64_t children = 0;
};

SchemaElement read_element(CompactReader& r) {
  SchemaElement element;
  r.begin_struct();
  for (Field f; r.field(f);) {
    if (f.is(3, kI32)) {
      element.repetition = r.integer();
    } else if (f.is(4, kBinary)) {
      element.name = r.binary();
    } else if (f.is(5, kI32)) {
      element.children = r.integer();
    } else {
      r.skip(f);
    }
  }
  return element;
}

/// Whether the columns are those of a flat table.
bool read_schema(CompactReader& r, std::vector<std::string>& columns) {
  bool flat = true;
  const std::size_t count = r.list(kStruct);
  for (std::size_t i = 0; i < count && r.ok(); ++i) {
    SchemaElement element = read_element(r);
    if (i == 0) {
      flat = element.children == static_cast<std::int64_t>(count) - 1;
    } else {
      flat = flat && element.children == 0 && element.repetition == parquet::kRequired;
      columns.push_back(std::move(element.name));
    }
  }
  return flat && count > 0;
}

ParquetMetadata::Chunk read_chunk(CompactReader& r) {
  ParquetMetadata::Chunk chunk;
  r.begin_struct();
  for (Field f; r.field(f);) {
    if (!f.is(3, kStruct)) {
      r.skip(f);
      continue;
    }
    r.begin_struct();
    for (Field m; r.field(m);) {
      if (m.is(1, kI32)) {
        chunk.type = r.integer();
      } else if (m.is(4, kI32)) {
        chunk.codec = r.integer();
      } else if (m.is(7, kI64)) {
        chunk.size = r.integer();
      } else if (m.is(9, kI64)) {
        chunk.offset = r.integer();
      } else {
        r.skip(m);
      }
    }
  }
  return chunk;
}

ParquetMetadata::Group read_group(CompactReader& r) {
  ParquetMetadata::Group group;
  r.begin_struct();
  for (Field f; r.field(f);) {
    if (f.is(1, kList)) {
      const std::size_t count = r.list(kStruct);
      for (std::size_t i = 0; i < count && r.ok(); ++i) group.chunks.push_back(read_chunk(r));
    } else if (f.is(3, kI64)) {
      group.rows = r.integer();
    } else {
      r.skip(f);
    }
  }
  return group;
}

}  // namespace

std::optional<ParquetMetadata> read_metadata(std::string_view footer) {
  ParquetMetadata metadata;
  CompactReader r(footer);
  bool flat = false;
  r.begin_struct();
  for (Field f; r.field(f);) {
    if (f.is(2, kList)) {
      flat = read_schema(r, metadata.columns);
    } else if (f.is(3, kI64)) {
      metadata.rows = r.integer();
    } else if (f.is(4, kList)) {
      const std::size_t count = r.list(kStruct);
      for (std::size_t i = 0; i < count && r.ok(); ++i) metadata.groups.push_back(read_group(r));
    } else {
      r.skip(f);
    }
  }
  return r.ok() && flat ? std::optional(std::move(metadata)) : std::nullopt;
}

std::optional<PageHeader> read_page_header(std::string_view bytes) {
  PageHeader page;
  std::int64_t kind = -1;
  CompactReader r(bytes);
  r.begin_struct();
  for (Field f; r.field(f);) {
    if (f.is(1, kI32)) {
      kind = r.integer();
    } else if (f.is(2, kI32)) {
      page.uncompressed = r.integer();
    } else if (f.is(3, kI32)) {
      page.compressed = r.integer();
    } else if (f.is(5, kStruct)) {
      r.begin_struct();
      for (Field m; r.field(m);) {
        if (m.is(1, kI32)) {
          page.values = r.integer();
        } else if (m.is(2, kI32)) {
          page.encoding = r.integer();
        } else {
          r.skip(m);
        }
      }
    } else {
      r.skip(f);
    }
  }
  page.header = static_cast<std::int64_t>(r.position());
  return r.ok() && kind == parquet::kDataPage ? std::optional(page) : std::nullopt;
}

}  // namespace graspd
