// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a page may ask for.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace graspd {

/// Frames up to this one have been drawn.
struct AckCommand {
  std::int64_t serial = 0;
};
/// This page alone: hold the picture, go on, or take just the next frame.
enum class FlowCommand { kPause, kResume, kStep };
/// This page alone: another source, by its channel.
struct SourceCommand {
  std::string channel;
};
/// Settings of one source; what is absent stays as it is.
struct SetCommand {
  std::string source;  ///< name
  std::optional<double> theta_low_deg, theta_high_deg, edge_share, leaf_size_m;
  std::optional<std::string> gripper;  ///< name of an installed one
};
enum class ConfigCommand { kUndo, kReset };
/// The log's player, for all pages.
struct PlayerCommand {
  std::optional<bool> playing;
  std::optional<double> speed;
  std::optional<std::int64_t> seek_us;  ///< from the log's start
  bool step = false;
};

using Command =
    std::variant<AckCommand, FlowCommand, SourceCommand, SetCommand, ConfigCommand, PlayerCommand>;

/// Nothing unless it is one JSON object of a known type with members of the right types and ranges, and no
/// others. Trusts nothing in the text.
[[nodiscard]] std::optional<Command> parse_command(std::string_view text);

/// Whether it changes more than what its own page sees.
[[nodiscard]] bool needs_token(const Command& command);

}  // namespace graspd
