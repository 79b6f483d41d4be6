// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/effective_config.hpp"

namespace graspd {

std::string effective_config(ServiceConfig config) {
  for (SourceConfig& source : config.sources) source.gripper.installed_name.clear();
  // What has no part in what a frame's answer is.
  config.workers = ServiceConfig{}.workers;
  config.threads = ServiceConfig{}.threads;
  config.lcm.url.clear();
  return print(config);
}

ServiceConfig load_replay_config(const std::string& file, const std::string& gripper,
                                 const std::string& key_file) {
  ConfigLayers layers;
  layers.file = file;
  layers.gripper = gripper;
  ServiceConfig config = load_layers(layers);
  if (!key_file.empty()) config.authentication.key_file = std::filesystem::absolute(key_file).string();
  return config;
}

}  // namespace graspd
