// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Logs on a command line -> the files that they consist of.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace graspd {

/// A file stays as given; the name of a log that was rotated stands for FILE.00, FILE.01, ... as far as they
/// follow each other; a folder for the event logs in it, sorted naturally. Throws EventLogError for what does
/// not exist and for folders without a log.
[[nodiscard]] std::vector<std::filesystem::path> list_logs(const std::vector<std::string>& arguments);

}  // namespace graspd
