// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/web/assets.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "client/common/read_file.hpp"

namespace graspd {
namespace {

namespace fs = std::filesystem;

// Where Vite puts files that have a hash of their content in their name.
constexpr std::string_view kHashedFolder = "/assets/";

bool is_inside(const fs::path& file, const fs::path& folder) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end() && rest != file.end();
}

}  // namespace

std::string content_type(std::string_view path) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kTypes{{
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".json", "application/json"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".ico", "image/x-icon"},
      {".txt", "text/plain; charset=utf-8"},
  }};
  for (const auto& [ending, type] : kTypes)
    if (path.ends_with(ending)) return std::string(type);
  return "application/octet-stream";
}

Assets::Assets(const fs::path& folder) {
  if (folder.empty()) return;
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error || !fs::is_directory(root))
    throw std::runtime_error(folder.string() + ": no such folder of files to serve");
  std::size_t total = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file() || !is_inside(fs::canonical(entry.path()), root)) continue;
    std::string path = "/";
    path += entry.path().lexically_relative(root).generic_string();
    total += entry.file_size();
    if (total > kMaxBytes) throw std::runtime_error(folder.string() + ": too large to be a page");
    files_[path] = {content_type(path), read_file(entry.path()), path.starts_with(kHashedFolder)};
  }
}

const Asset* Assets::find(std::string_view path) const {
  const auto found = files_.find(path == "/" ? "/index.html" : path);
  return found == files_.end() ? nullptr : &found->second;
}

}  // namespace graspd
