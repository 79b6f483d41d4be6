// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/cloud_list.hpp"

#include <algorithm>
#include <system_error>

#include "client/common/cloud_file.hpp"

namespace graspd {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Takes the digits at the start off, without leading zeros.
std::string_view take_number(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
  std::string_view number = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(number.size());
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

std::vector<std::filesystem::path> cloud_files_in(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::directory_iterator entries(folder, error);
  if (error) throw CloudFileError(folder.string() + ": " + error.message());
  std::vector<std::filesystem::path> files;
  for (const auto& entry : entries) {
    if (!entry.is_directory(error) && is_cloud_file(entry.path())) files.push_back(entry.path());
  }
  if (files.empty()) throw CloudFileError(folder.string() + ": holds no PCD or PLY files");
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  return files;
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a;
  const std::string_view whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a[0]) && is_digit(b[0])) {
      const auto x = take_number(a);
      const auto y = take_number(b);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else if (a[0] != b[0]) {
      return static_cast<unsigned char>(a[0]) < static_cast<unsigned char>(b[0]);
    } else {
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  if (a.empty() != b.empty()) return a.empty();
  // Only leading zeros differ: still an order, so that no two names are equal.
  return whole_a < whole_b;
}

std::vector<std::filesystem::path> list_cloud_files(const std::vector<std::string>& arguments) {
  std::vector<std::filesystem::path> files;
  for (const std::string& argument : arguments) {
    std::error_code error;
    const auto status = std::filesystem::status(argument, error);
    if (status.type() == std::filesystem::file_type::not_found)
      throw CloudFileError(argument + ": no such file or folder");
    if (error) throw CloudFileError(argument + ": " + error.message());
    if (std::filesystem::is_directory(status)) {
      const auto inside = cloud_files_in(argument);
      files.insert(files.end(), inside.begin(), inside.end());
    } else {
      files.emplace_back(argument);
    }
  }
  return files;
}

}  // namespace graspd
