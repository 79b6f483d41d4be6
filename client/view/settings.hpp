// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The daemon's settings as pages see and change them.
#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/view/commands.hpp"
#include "graspd/control_t.hpp"
#include "service/config/service_config.hpp"

namespace graspd {

class Settings {
 public:
  /// file: the daemon's service file; empty: its defaults. Throws as load_layers() does.
  explicit Settings(std::string file);

  /// What control messages have set, as status_t says; true when that changed something.
  bool use_overrides(const std::string& overrides);

  [[nodiscard]] const ServiceConfig& config() const { return config_; }
  /// From the cloud's frame to that of the handles, for clouds of a channel.
  [[nodiscard]] Eigen::Isometry3f T_target_cloud(const std::string& channel) const;

  /// Why such a command cannot be; nothing: it can.
  [[nodiscard]] std::optional<std::string> problem(const SetCommand& command) const;
  /// The YAML of a SET.
  [[nodiscard]] std::string yaml(const SetCommand& command) const;

  /// {"type":"settings", "can_control": ..., "grippers": [...], "sources": [{name, channel, ...}]}
  [[nodiscard]] std::string json(bool can_control) const;

 private:
  [[nodiscard]] const SourceConfig* source_named(const std::string& name) const;

  std::string file_;
  std::string overrides_;
  ServiceConfig config_;
  std::vector<std::string> grippers_;  // names of the installed ones
};

}  // namespace graspd
