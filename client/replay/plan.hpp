// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// An archive split into shards of equal work, for as many machines as there are.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "client/replay/archive.hpp"
#include "client/replay/replay.hpp"

namespace graspd {

struct Shard {
  std::vector<LogPart> parts;
  std::int64_t frames = 0;
};

/// Every event of the logs is in one shard.
struct Plan {
  std::vector<std::filesystem::path> logs;
  std::vector<std::int64_t> log_bytes;
  std::string keep;
  std::vector<Shard> shards;
  std::int64_t frames = 0;  ///< of all shards
};

/// Reads the headers of all events. The work of a frame is taken to be its points. At most `shards`, fewer
/// where there are not as many frames; always one. Throws EventLogError, ConfigError.
[[nodiscard]] Plan make_plan(const std::vector<std::filesystem::path>& logs, const ServiceConfig& service,
                             const std::string& keep, std::size_t shards);

/// A folder with plan.json, config.yaml and shards/, all that a task needs besides the logs. Refuses a folder
/// that holds another plan; throws std::runtime_error.
void save_plan(const std::filesystem::path& folder, const Plan& plan, const ServiceConfig& service);

/// Throws std::runtime_error that names the file for what is no plan, or a plan for logs that have changed.
[[nodiscard]] Plan load_plan(const std::filesystem::path& folder);

/// What a task for the shard runs.
[[nodiscard]] ReplayConfig shard_config(const std::filesystem::path& folder, const Plan& plan,
                                        std::size_t shard);
[[nodiscard]] std::filesystem::path shard_log(const std::filesystem::path& folder, std::size_t shard);

}  // namespace graspd
