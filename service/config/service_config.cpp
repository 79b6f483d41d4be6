// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/service_config.hpp"

#include <algorithm>
#include <regex>
#include <utility>

namespace graspd {
namespace {

constexpr std::size_t kLongestChannel = 63;  // LCM's limit

std::string source_key(std::size_t index, const char* key) {
  return "sources[" + std::to_string(index) + "]." + key;
}

/// Why a name cannot be published on, for a name that cannot.
std::optional<std::string> channel_problem(const std::string& channel) {
  if (channel.empty()) return "no channel: expected a name";
  if (channel.size() > kLongestChannel) return "too long for LCM: expected at most 63 characters";
  const bool printable =
      std::all_of(channel.begin(), channel.end(), [](char c) { return c > ' ' && c < 0x7f; });
  if (!printable) return "not a channel: expected printable ASCII without spaces";
  return std::nullopt;
}

std::optional<std::string> regex_problem(const std::string& channel_regex) {
  if (channel_regex.empty()) return "no channel: expected a name or a regular expression";
  if (is_plain_channel(channel_regex)) return channel_problem(channel_regex);
  try {
    const std::regex compiled(channel_regex);
    return std::nullopt;
  } catch (const std::regex_error&) {
    return "not a regular expression: expected one that compiles";
  }
}

/// A channel for messages to the daemon; empty: none.
std::optional<ConfigProblem> validate_input(const ServiceConfig& config, const char* key,
                                            const std::string& channel) {
  if (channel.empty()) return std::nullopt;
  if (const auto problem = channel_problem(channel)) return ConfigProblem{key, *problem};
  if (channel == config.lcm.status_channel)
    return ConfigProblem{key, "two types on one channel: expected another than lcm.status_channel"};
  for (std::size_t i = 0; i < config.sources.size(); ++i) {
    if (matches_channel(config.sources[i].channel, channel))
      return ConfigProblem{source_key(i, "channel"),
                           "matches " + std::string(key) + " " + channel + ": expected clouds only"};
  }
  return std::nullopt;
}

/// A channel for answers.
std::optional<ConfigProblem> validate_output(const ServiceConfig& config, const std::string& key,
                                             const std::string& channel) {
  if (const auto problem = channel_problem(channel)) return ConfigProblem{key, *problem};
  const LcmConfig& lcm = config.lcm;
  const std::pair<const char*, const std::string&> others[] = {{"lcm.status_channel", lcm.status_channel},
                                                               {"lcm.control_channel", lcm.control_channel},
                                                               {"lcm.request_channel", lcm.request_channel}};
  for (const auto& [other_key, other] : others)
    if (channel == other)
      return ConfigProblem{key, "two types on one channel: expected another than " + std::string(other_key)};
  return std::nullopt;
}

std::optional<ConfigProblem> validate_source_channels(const ServiceConfig& config, std::size_t i) {
  const SourceConfig& source = config.sources[i];
  if (const auto problem = regex_problem(source.channel))
    return ConfigProblem{source_key(i, "channel"), *problem};
  if (auto problem = validate_output(config, source_key(i, "handles_channel"), source.handles_channel))
    return problem;
  if (auto problem = validate_output(config, source_key(i, "segments_channel"), source.segments_channel))
    return problem;
  for (const SourceConfig& other : config.sources)
    if (source.segments_channel == other.handles_channel)
      return ConfigProblem{source_key(i, "segments_channel"),
                           "two types on one channel: expected another than any handles_channel"};
  return std::nullopt;
}

std::optional<ConfigProblem> validate_channels(const ServiceConfig& config) {
  const LcmConfig& lcm = config.lcm;
  if (const auto problem = channel_problem(lcm.status_channel))
    return ConfigProblem{"lcm.status_channel", *problem};
  for (std::size_t i = 0; i < config.sources.size(); ++i)
    if (auto problem = validate_source_channels(config, i)) return problem;
  return std::nullopt;
}

std::optional<ConfigProblem> validate_inputs(const ServiceConfig& config) {
  const LcmConfig& lcm = config.lcm;
  if (auto problem = validate_input(config, "lcm.control_channel", lcm.control_channel)) return problem;
  if (auto problem = validate_input(config, "lcm.request_channel", lcm.request_channel)) return problem;
  if (!lcm.request_channel.empty() && lcm.request_channel == lcm.control_channel)
    return ConfigProblem{"lcm.request_channel",
                         "two types on one channel: expected another than lcm.control_channel"};
  return std::nullopt;
}

std::optional<ConfigProblem> validate_no_loop(const ServiceConfig& config) {
  std::vector<std::string> own{config.lcm.status_channel};
  for (const SourceConfig& source : config.sources)
    own.insert(own.end(), {source.handles_channel, source.segments_channel});
  for (std::size_t i = 0; i < config.sources.size(); ++i) {
    for (const std::string& channel : own) {
      if (matches_channel(config.sources[i].channel, channel))
        return ConfigProblem{source_key(i, "channel"),
                             "matches " + channel + ", which graspd itself publishes: expected clouds only"};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<ConfigProblem> ServiceConfig::validate() const {
  if (sources.empty()) return ConfigProblem{"sources", "nothing to work on: expected at least one source"};
  if (sources.size() > static_cast<std::size_t>(limits.max_sources))
    return ConfigProblem{"limits.max_sources",
                         "fewer than there are sources: expected at least " + std::to_string(sources.size())};
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (sources[i].name.empty()) return ConfigProblem{source_key(i, "name"), "no name: expected one"};
    for (std::size_t k = 0; k < i; ++k) {
      if (sources[k].name == sources[i].name)
        return ConfigProblem{source_key(i, "name"), "two sources have it: expected a name of its own"};
    }
  }
  if (auto problem = validate_channels(*this)) return problem;
  if (auto problem = validate_no_loop(*this)) return problem;
  return validate_inputs(*this);
}

bool matches_channel(const std::string& channel_regex, const std::string& channel) {
  if (is_plain_channel(channel_regex)) return channel_regex == channel;
  return std::regex_match(channel, std::regex(channel_regex));
}

std::size_t first_source(const ServiceConfig& config, const std::string& channel) {
  const auto found =
      std::find_if(config.sources.begin(), config.sources.end(),
                   [&](const SourceConfig& source) { return matches_channel(source.channel, channel); });
  return static_cast<std::size_t>(found - config.sources.begin());
}

bool is_own_channel(const ServiceConfig& config, std::string_view channel) {
  const LcmConfig& lcm = config.lcm;
  return channel == lcm.status_channel || channel == lcm.control_channel || channel == lcm.request_channel ||
         std::any_of(config.sources.begin(), config.sources.end(), [&](const SourceConfig& source) {
           return source.handles_channel == channel || source.segments_channel == channel;
         });
}

bool is_plain_channel(std::string_view channel_regex) {
  return channel_regex.find_first_of(R"(\^$.|?*+()[]{})") == std::string_view::npos;
}

}  // namespace graspd
