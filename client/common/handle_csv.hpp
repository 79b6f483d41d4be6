// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Handle lists as CSV: the one form for people's tools, the same from every program.
#pragma once
#include <string>
#include <string_view>

#include "graspd/handle_list_t.hpp"

namespace graspd {

/// A cell as RFC 4180 has it: in quotes where it holds a comma, a quote or a line's end.
[[nodiscard]] std::string csv_cell(std::string_view text);

/// The line of column names, with its newline.
[[nodiscard]] std::string handle_csv_header();

enum class EmptyLists { kSkip, kWriteRow };

/// A line for each handle, best first; numbers are written so that reading them as float gives the same
/// float. A list without handles gives no line, or one with id -1 and empty cells.
[[nodiscard]] std::string handle_csv_rows(const handle_list_t& list, EmptyLists empty = EmptyLists::kSkip);

}  // namespace graspd
