// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What becomes of an event, by its channel.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <regex>
#include <string>

#include "service/config/service_config.hpp"
#include "service/daemon/frame_processor.hpp"
#include "service/runtime/clock.hpp"

namespace graspd {

struct ChannelUse {
  std::unique_ptr<const FrameProcessor> processor;  ///< none: no source takes clouds from it
  bool keep = false;                                ///< its events go into the output as they are
};

/// Belongs to one thread; what it gives may be used by others. The clock must outlive it.
class ChannelTable {
 public:
  /// `keep`: regular expression for whole names; empty: none. Throws ConfigError for one that is none.
  ChannelTable(ServiceConfig config, const std::string& keep, const Clock& clock);

  /// The same object for a name as long as it is used for anything.
  [[nodiscard]] const ChannelUse& find(const std::string& channel);

  [[nodiscard]] const ServiceConfig& config() const { return config_; }

 private:
  ServiceConfig config_;
  std::optional<std::regex> keep_;
  const Clock& clock_;
  std::map<std::string, ChannelUse> channels_;
};

}  // namespace graspd
