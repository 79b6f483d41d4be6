// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/view/settings.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "client/common/json_writer.hpp"
#include "client/common/text.hpp"
#include "service/config/config_error.hpp"
#include "service/config/config_folders.hpp"

namespace graspd {
namespace {

std::vector<std::string> installed_grippers() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(installed_config_folder() / "grippers", error))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

ServiceConfig load(const std::string& file, const std::string& overrides) {
  ConfigLayers layers;
  layers.file = file;
  layers.overrides = overrides;
  return load_layers(layers);
}

std::string member(const char* key, const std::optional<double>& value) {
  return value ? printed("%s: %.9g, ", key, *value) : "";
}

}  // namespace

Settings::Settings(std::string file)
    : file_(std::move(file)), config_(load(file_, "")), grippers_(installed_grippers()) {}

bool Settings::use_overrides(const std::string& overrides) {
  if (overrides == overrides_) return false;
  overrides_ = overrides;
  try {
    config_ = load(file_, overrides);
  } catch (const ConfigError&) {
    return false;  // of a daemon with another file: what is known stays
  }
  return true;
}

const SourceConfig* Settings::source_named(const std::string& name) const {
  const auto found = std::find_if(config_.sources.begin(), config_.sources.end(),
                                  [&](const SourceConfig& source) { return source.name == name; });
  return found == config_.sources.end() ? nullptr : &*found;
}

Eigen::Isometry3f Settings::T_target_cloud(const std::string& channel) const {
  const auto found =
      std::find_if(config_.sources.begin(), config_.sources.end(),
                   [&](const SourceConfig& source) { return matches_channel(source.channel, channel); });
  if (found == config_.sources.end() || !found->sensor_pose.given()) return Eigen::Isometry3f::Identity();
  return found->sensor_pose.T_target_cloud();
}

std::optional<std::string> Settings::problem(const SetCommand& command) const {
  if (source_named(command.source) == nullptr) return "no source of that name";
  if (command.gripper && std::find(grippers_.begin(), grippers_.end(), *command.gripper) == grippers_.end())
    return "no gripper of that name";
  return std::nullopt;
}

std::string Settings::yaml(const SetCommand& command) const {
  const SourceConfig* source = source_named(command.source);
  std::string detect = "smoothness: {" + member("theta_low_deg", command.theta_low_deg) +
                       member("theta_high_deg", command.theta_high_deg) +
                       member("edge_share", command.edge_share) + "}";
  if (command.leaf_size_m && source != nullptr) {
    // Neighbourhoods reach as many voxels as before.
    const DetectConfig& now = source->detect;
    const double voxels = now.downsample.leaf_size_m > 0
                              ? static_cast<double>(now.neighborhoods.radius_m / now.downsample.leaf_size_m)
                              : 3;
    detect += ", downsample: {" + member("leaf_size_m", command.leaf_size_m) + "}";
    detect += ", neighborhoods: {" + member("radius_m", voxels * *command.leaf_size_m) + "}";
  }
  std::string yaml = "sources: [{name: " + json_quoted(command.source) + ", ";
  if (command.gripper) yaml += "gripper: " + json_quoted(*command.gripper) + ", ";
  return yaml + "detect: {" + detect + "}}]";
}

std::string Settings::json(bool can_control) const {
  JsonWriter json;
  json.begin_object().member("type", "settings");
  json.key("can_control").value(std::int64_t{can_control ? 1 : 0});
  json.key("grippers").begin_array();
  for (const std::string& name : grippers_) json.value(name);
  json.end_array().key("sources").begin_array();
  for (const SourceConfig& source : config_.sources) {
    const DetectConfig& detect = source.detect;
    json.begin_object().member("name", source.name).member("channel", source.channel);
    json.member("gripper", source.gripper.gripper.name);
    json.key("leaf_size_m").value_float(static_cast<double>(detect.downsample.leaf_size_m));
    json.key("theta_low_deg").value_float(static_cast<double>(detect.smoothness.theta_low_deg));
    json.key("theta_high_deg").value_float(static_cast<double>(detect.smoothness.theta_high_deg));
    json.key("edge_share").value_float(static_cast<double>(detect.smoothness.edge_share));
    json.end_object();
  }
  return json.end_array().end_object().str();
}

}  // namespace graspd
