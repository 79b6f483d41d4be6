// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/config/temporary_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "service/config/config_error.hpp"

namespace graspd {

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "graspd-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::filesystem::remove_all(path_);
}

std::filesystem::path TemporaryFolder::write(const std::string& name, std::string_view text) const {
  const auto file = path_ / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

std::string config_error(const std::filesystem::path& file, const std::function<void()>& call) {
  try {
    call();
  } catch (const ConfigError& e) {
    const std::string line = e.what();
    const std::string start = file.string() + ": ";
    return line.starts_with(start) ? line.substr(start.size()) : "NOT NAMING THE FILE: " + line;
  }
  return "";
}

}  // namespace graspd
