// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/log/log_parts.hpp"

#include <algorithm>

#include "client/common/cloud_list.hpp"
#include "client/log/event_log_reader.hpp"
#include "client/log/recorder.hpp"

namespace graspd {
namespace {

std::vector<std::filesystem::path> logs_in_folder(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> logs;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (is_event_log(entry.path())) logs.push_back(entry.path());
  std::sort(logs.begin(), logs.end(), [](const auto& a, const auto& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  if (logs.empty()) throw EventLogError(folder.string() + ": no event log in this folder");
  return logs;
}

std::vector<std::filesystem::path> rotated_parts(const std::filesystem::path& log) {
  std::vector<std::filesystem::path> parts;
  std::error_code error;
  for (int n = 0; std::filesystem::exists(rotated_path(log, n), error); ++n)
    parts.push_back(rotated_path(log, n));
  if (parts.empty())
    throw EventLogError(log.string() + ": no such log, and no " + rotated_path(log, 0).filename().string());
  return parts;
}

}  // namespace

std::vector<std::filesystem::path> list_logs(const std::vector<std::string>& arguments) {
  std::vector<std::filesystem::path> logs;
  std::error_code error;
  for (const std::filesystem::path argument : arguments) {
    std::vector<std::filesystem::path> found{argument};
    if (std::filesystem::is_directory(argument, error)) {
      found = logs_in_folder(argument);
    } else if (!std::filesystem::exists(argument, error)) {
      found = rotated_parts(argument);
    }
    logs.insert(logs.end(), found.begin(), found.end());
  }
  return logs;
}

}  // namespace graspd
