// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/config_folders.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

namespace graspd {
namespace {

/// The names of the YAML files in both folders, for the message.
std::string known_names(const std::vector<std::filesystem::path>& folders) {
  std::vector<std::string> names;
  for (const auto& folder : folders) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
      if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

std::filesystem::path installed_config_folder() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  return (program.parent_path() / ".." / "share" / "graspd" / "config").lexically_normal();
}

bool is_path(const std::string& name_or_path) {
  return name_or_path.find('/') != std::string::npos || name_or_path.ends_with(".yaml");
}

std::filesystem::path find_config_file(const std::string& name_or_path, const std::string& kind,
                                       const std::filesystem::path& folder, const ConfigPlace& place) {
  std::error_code error;
  if (is_path(name_or_path)) {
    std::filesystem::path file = folder / name_or_path;
    if (!std::filesystem::exists(file, error)) place.fail("no such file", file.string(), "");
    return file;
  }
  const std::vector<std::filesystem::path> folders{folder / kind, installed_config_folder() / kind};
  for (const auto& candidate : folders) {
    std::filesystem::path file = candidate / (name_or_path + ".yaml");
    if (std::filesystem::exists(file, error)) return file;
  }
  const std::string names = known_names(folders);
  place.fail("no such file in " + kind + "/", name_or_path, names.empty() ? "a path" : names + " or a path");
}

}  // namespace graspd
