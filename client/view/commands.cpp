// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/view/commands.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace graspd {
namespace {

using Json = nlohmann::json;

/// Reads the members of an object once; whatever is wrong makes it bad as a whole.
class Members {
 public:
  explicit Members(const Json& object) : object_(object) {}

  std::optional<double> number(const char* name, double min, double max) {
    const Json* member = find(name);
    if (member == nullptr) return std::nullopt;
    if (!member->is_number()) return bad<double>();
    const double value = member->get<double>();
    return std::isfinite(value) && value >= min && value <= max ? std::optional(value) : bad<double>();
  }
  std::optional<std::int64_t> integer(const char* name) {
    const Json* member = find(name);
    if (member == nullptr) return std::nullopt;
    constexpr double kMost = 9e15;  // as far as a page counts without gaps
    const double value = member->is_number() ? member->get<double>() : -1;
    if (!(value >= 0 && value <= kMost && value == std::floor(value))) return bad<std::int64_t>();
    return static_cast<std::int64_t>(value);
  }
  std::optional<bool> boolean(const char* name) {
    const Json* member = find(name);
    if (member == nullptr) return std::nullopt;
    return member->is_boolean() ? std::optional(member->get<bool>()) : bad<bool>();
  }
  /// Of printable ASCII.
  std::optional<std::string> text(const char* name) {
    const Json* member = find(name);
    if (member == nullptr) return std::nullopt;
    constexpr std::size_t kLongest = 255;
    if (!member->is_string()) return bad<std::string>();
    const auto& value = member->get_ref<const std::string&>();
    const bool printable =
        std::all_of(value.begin(), value.end(), [](char c) { return c >= 0x20 && c < 0x7f; });
    return printable && !value.empty() && value.size() <= kLongest ? std::optional(value)
                                                                   : bad<std::string>();
  }
  /// Whether everything was right, and nothing else is there.
  [[nodiscard]] bool good() const { return good_ && object_.size() == taken_; }

 private:
  const Json* find(const char* name) {
    const auto found = object_.find(name);
    if (found == object_.end()) return nullptr;
    ++taken_;
    return &*found;
  }
  template <class T>
  std::optional<T> bad() {
    good_ = false;
    return std::nullopt;
  }

  const Json& object_;
  std::size_t taken_ = 0;
  bool good_ = true;
};

SetCommand read_set(Members& members) {
  SetCommand set;
  set.source = members.text("source").value_or("");
  set.theta_low_deg = members.number("theta_low_deg", 0, 90);
  set.theta_high_deg = members.number("theta_high_deg", 0, 90);
  set.edge_share = members.number("edge_share", 0, 1);
  set.leaf_size_m = members.number("leaf_size_m", 0.0005, 0.1);
  set.gripper = members.text("gripper");
  return set;
}

PlayerCommand read_player(Members& members) {
  PlayerCommand player;
  player.playing = members.boolean("playing");
  player.speed = members.number("speed", 0.01, 100);
  player.seek_us = members.integer("seek_us");
  player.step = members.boolean("step").value_or(false);
  return player;
}

std::optional<Command> read_command(const std::string& type, Members& members) {
  if (type == "ack") return AckCommand{members.integer("serial").value_or(0)};
  if (type == "pause") return FlowCommand::kPause;
  if (type == "resume") return FlowCommand::kResume;
  if (type == "step") return FlowCommand::kStep;
  if (type == "source") return SourceCommand{members.text("channel").value_or("")};
  if (type == "set") return read_set(members);
  if (type == "undo") return ConfigCommand::kUndo;
  if (type == "reset") return ConfigCommand::kReset;
  if (type == "player") return read_player(members);
  return std::nullopt;
}

}  // namespace

std::optional<Command> parse_command(std::string_view text) {
  const Json object = Json::parse(text, nullptr, false);
  if (!object.is_object()) return std::nullopt;  // also where it is no JSON
  Members members(object);
  const std::optional<std::string> type = members.text("type");
  if (!type) return std::nullopt;
  std::optional<Command> command = read_command(*type, members);
  return command && members.good() ? command : std::nullopt;
}

bool needs_token(const Command& command) {
  return std::holds_alternative<SetCommand>(command) || std::holds_alternative<ConfigCommand>(command) ||
         std::holds_alternative<PlayerCommand>(command);
}

}  // namespace graspd
