// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Formatting text: printf into strings, columns that line up.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace graspd {

/// As printf.
[[nodiscard]] std::string printed(const char* format, ...) __attribute__((format(printf, 1, 2)));

/// Text safe to show: control characters become '?'.
[[nodiscard]] std::string plain_line(std::string_view text);

/// Takes the first word off a text: what stands between spaces or line ends. Empty at the end.
[[nodiscard]] std::string_view next_word(std::string_view& text);
[[nodiscard]] std::vector<std::string_view> split_words(std::string_view text);

/// Columns as wide as their widest cell; the first to the left, the others to the right, two spaces between.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header);
  void add(std::vector<std::string> row);  ///< missing cells at the end are empty
  [[nodiscard]] std::string str() const;   ///< every line ends with a newline

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// The value that share [0, 1] of the values do not exceed (nearest rank); 0 without values.
[[nodiscard]] double percentile(std::vector<double> values, double share);

}  // namespace graspd
