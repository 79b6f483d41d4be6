// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Why there is no handle on a segment: a table for people, CSV and JSON for their tools.
#pragma once
#include <string>
#include <string_view>

#include "client/detect/file_detection.hpp"

namespace graspd {

/// What a failed check means, in a few words.
[[nodiscard]] std::string_view in_words(Failure failure);

/// A line for each segment: where it is, how many candidates were tried on it, how many passed all checks
/// and how many of those are in the list; where none passed, why, and how many failed which check. Then a
/// line that counts the segments without a handle by reason. Every line ends with a newline.
[[nodiscard]] std::string explanation_table(const FileDetection& detected);

/// The line of column names, with its newline; ends with one column for each check.
[[nodiscard]] std::string explanation_csv_header();

/// A line for each segment; nothing without segments. No cell is empty.
[[nodiscard]] std::string explanation_csv_rows(const FileDetection& detected);

/// The list as JSON (handle_text.hpp) with a further member, segments; no newline.
[[nodiscard]] std::string explanation_json(const FileDetection& detected);

}  // namespace graspd
