// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The columns of the two tables, in the order in which cells are written and read.
#pragma once
#include <vector>

#include "client/table/parquet_file.hpp"

namespace graspd {

[[nodiscard]] std::vector<Column> handle_columns();
[[nodiscard]] std::vector<Column> frame_columns();

}  // namespace graspd
