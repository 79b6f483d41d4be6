// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Figures as tables, and tables as Markdown, CSV and JSON.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "client/evaluate/metrics.hpp"

namespace graspd {

/// A share [0, 1], shown as a percentage; nothing where there was nothing to count.
struct Percentage {
  std::optional<double> value;
};

/// Nothing, text, a count, a number, a share.
using Cell = std::variant<std::monostate, std::string, std::int64_t, double, Percentage>;

/// Rows have one cell a column.
struct Table {
  std::string name;   ///< lower_snake, for programs: key in JSON, first column in CSV
  std::string title;  ///< for people
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;
};

enum class TableFormat { kMarkdown, kCsv, kJson };

/// Markdown: a heading and a table each, percentages with one decimal. CSV: blocks of lines that start with
/// the table's name, an empty line between the blocks. JSON: one object, arrays of objects by table name,
/// shares as fractions, null where there is nothing.
[[nodiscard]] std::string write_tables(std::span<const Table> tables, TableFormat format);

/// A run of some configuration, or a file of handles, over the same frames.
struct NamedRun {
  std::string name;
  std::vector<JudgedFrame> frames;
};

/// In the shape of the paper's Table 2: each frame with its objects, handles and recall, then the total.
[[nodiscard]] Table frame_table(std::span<const JudgedFrame> frames);

/// In the shape of the paper's Table 1: each object with the frames that show it, and the share in which it
/// has a valid handle, then the total.
[[nodiscard]] Table object_table(std::span<const JudgedFrame> frames);

/// The same two with a run beside the other, as the paper's tables show two methods. All runs are over the
/// same frames.
[[nodiscard]] Table frame_table_side_by_side(std::span<const NamedRun> runs);
[[nodiscard]] Table object_table_side_by_side(std::span<const NamedRun> runs);

/// All measures, a column each, one row a run.
[[nodiscard]] Table figures_table(std::span<const NamedRun> runs);

/// The same, one row a category and one for all frames.
[[nodiscard]] Table category_table(std::span<const JudgedFrame> frames);

/// Why handles are invalid, and how many.
[[nodiscard]] Table failure_table(std::span<const JudgedFrame> frames);

/// Score bins against the share of valid handles; the last row is the expected calibration error.
[[nodiscard]] Table calibration_table(std::span<const JudgedFrame> frames);

/// Every invalid handle with its reason.
[[nodiscard]] Table invalid_handle_table(std::span<const JudgedFrame> frames);

}  // namespace graspd
