// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/channel_table.hpp"

#include <algorithm>
#include <utility>

#include "service/config/config_error.hpp"

namespace graspd {
namespace {

// As a daemon has it that nobody has reconfigured.
constexpr std::int64_t kRevision = 1;
constexpr std::size_t kMostRemembered = 4096;

std::optional<std::regex> compiled(const std::string& expression) {
  if (expression.empty()) return std::nullopt;
  try {
    return std::regex(expression);
  } catch (const std::regex_error&) {
    throw ConfigError("--keep: not a regular expression: " + expression);
  }
}

}  // namespace

ChannelTable::ChannelTable(ServiceConfig config, const std::string& keep, const Clock& clock)
    : config_(std::move(config)), keep_(compiled(keep)), clock_(clock) {}

const ChannelUse& ChannelTable::find(const std::string& channel) {
  if (const auto known = channels_.find(channel); known != channels_.end()) return known->second;
  // However many names a damaged log makes up, memory stays bounded.
  if (channels_.size() >= kMostRemembered)
    std::erase_if(channels_, [](const auto& entry) { return !entry.second.processor && !entry.second.keep; });
  ChannelUse use;
  const std::size_t source =
      is_own_channel(config_, channel) ? config_.sources.size() : first_source(config_, channel);
  if (source < config_.sources.size())
    use.processor = std::make_unique<const FrameProcessor>(config_.sources[source], channel,
                                                           config_.limits.decode, clock_, kRevision);
  const auto is_output = [&](const SourceConfig& s) { return s.handles_channel == channel; };
  use.keep = keep_ && std::regex_match(channel, *keep_) &&
             std::none_of(config_.sources.begin(), config_.sources.end(), is_output);
  return channels_.emplace(channel, std::move(use)).first->second;
}

}  // namespace graspd
