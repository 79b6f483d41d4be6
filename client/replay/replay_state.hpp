// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// How far a replay has come: what a stopped one goes on from, and what is said of one that is done.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "client/replay/archive.hpp"

namespace graspd {

struct ReplayState {
  ArchivePosition input;                        ///< behind the last event that is in the output
  std::int64_t frames_seen = 0;                 ///< clouds of sources up to there, chosen or not
  std::int64_t frames = 0;                      ///< of these, those that were answered
  std::int64_t kept = 0;                        ///< original events in the output
  std::int64_t handles = 0;                     ///< in all lists
  std::map<std::string, std::int64_t> answers;  ///< by status: OK, NO_HANDLES, ...
  std::int64_t output_bytes = 0;
  std::int64_t output_events = 0;
};

/// What a finished output file is.
struct Receipt {
  std::string identity;  ///< of the run: equal for equal input, configuration, options and version
  ReplayState state;
  std::string sha256;  ///< of the output file
};

/// Whoever reads the file finds a whole state, old or new. Throw std::runtime_error that names the file.
void save_state(const std::filesystem::path& file, const std::string& identity, const ReplayState& state);
void save_receipt(const std::filesystem::path& file, const Receipt& receipt);

/// Nothing when there is no such file or it is not whole. Throws std::runtime_error for a state of another
/// run.
[[nodiscard]] std::optional<ReplayState> load_state(const std::filesystem::path& file,
                                                    const std::string& identity);
[[nodiscard]] std::optional<Receipt> load_receipt(const std::filesystem::path& file);

}  // namespace graspd
