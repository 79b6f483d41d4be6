// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A folder for one test's files, gone with it.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace graspd {

class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// Writes a file, folders included; its path.
  std::filesystem::path write(const std::string& name, std::string_view text) const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The text of the ConfigError that the call throws, without "FILE: " in front; empty when it throws none.
[[nodiscard]] std::string config_error(const std::filesystem::path& file, const std::function<void()>& call);

}  // namespace graspd
