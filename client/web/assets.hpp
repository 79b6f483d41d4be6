// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The files that a web server serves, read once.
#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace graspd {

struct Asset {
  std::string content_type;
  std::string bytes;
  bool immutable = false;  ///< its name changes with its content
};

/// A request's path is a key in here and never the name of a file: no path leads out.
class Assets {
 public:
  static constexpr std::size_t kMaxBytes = std::size_t{64} << 20;

  /// An empty path: none. Throws std::runtime_error when the folder cannot be read, or is larger than
  /// kMaxBytes. Links that lead out of it are left out.
  explicit Assets(const std::filesystem::path& folder);

  /// "/" stands for "/index.html". Null: there is none.
  [[nodiscard]] const Asset* find(std::string_view path) const;
  [[nodiscard]] std::size_t size() const { return files_.size(); }

 private:
  std::map<std::string, Asset, std::less<>> files_;
};

/// By the ending; application/octet-stream for those that pages do not need.
[[nodiscard]] std::string content_type(std::string_view path);

}  // namespace graspd
