// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Files -> configuration structs.
#include <array>

#include "service/config/config_folders.hpp"
#include "service/config/field_reader.hpp"
#include "service/config/read_service_config.hpp"
#include "service/config/service_config.hpp"
#include "service/config/yaml_file.hpp"

namespace graspd {
namespace {

std::filesystem::path folder_of(const ConfigPlace& place) {
  return std::filesystem::path(place.file).parent_path();
}

/// All keys but the name, which a file's own name stands in for.
void read_gripper(const YAML::Node& map, const ConfigPlace& place, const std::string& default_name,
                  Gripper& gripper) {
  std::vector<std::string> required = keys_of(gripper);
  std::erase(required, "name");
  gripper.name = default_name;
  read_struct(map, place, gripper, required);
}

/// A sensor file has the keys of `detect:`, and keeps the rest.
void read_sensor(const std::string& sensor, const ConfigPlace& place, DetectConfig& detect) {
  const auto file = find_config_file(sensor, "sensors", folder_of(place), place);
  const YAML::Node root = load_yaml(file);
  const ConfigPlace sensor_place{file.string(), ""};
  check_map(root, sensor_place, {"detect"}, {});
  read_struct(find(root, "detect"), sensor_place.child("detect"), detect);
}

SourceConfig read_source(const YAML::Node& map, const ConfigPlace& place, const DetectConfig& base) {
  static const std::array<std::string, 2> kRequired{"name", "channel"};
  SourceConfig source;
  source.detect = base;
  if (const YAML::Node sensor = find(map, "sensor")) {
    read_value(sensor, place.child("sensor"), Range{}, source.sensor);
    if (!source.sensor.empty()) read_sensor(source.sensor, place.child("sensor"), source.detect);
  }
  read_struct(map, place, source, kRequired);
  return source;
}

void set_box_frame(ServiceConfig& config) {
  for (SourceConfig& source : config.sources)
    source.detect.workspace.T_box_cloud = source.sensor_pose.T_target_cloud();
}

}  // namespace

void read_value(const YAML::Node& node, const ConfigPlace& place, const Range&, GripperSetting& value) {
  if (node.IsMap()) {
    value = GripperSetting{};
    read_gripper(node, place, "custom", value.gripper);
    return;
  }
  if (!node.IsScalar()) place.fail("wrong type", describe(node), "a gripper's name, path or keys");
  const auto file = find_config_file(node.Scalar(), "grippers", folder_of(place), place);
  value = find_gripper(file.string(), "");
}

ServiceConfig load_service_config(const std::filesystem::path& file) {
  return read_service_config(load_yaml(file), ConfigPlace{file.string(), ""});
}

ServiceConfig read_service_config(const YAML::Node& root, const ConfigPlace& place) {
  ServiceConfig config;
  check_map(root, place, keys_of(config), {});
  FieldReader reader(root, place);
  ServiceConfig::visit(config, reader);
  if (const YAML::Node sources = find(root, "sources")) {
    const ConfigPlace list = place.child("sources");
    config.sources.resize(list_length(sources, list));
    for (std::size_t i = 0; i < config.sources.size(); ++i)
      config.sources[i] = read_source(sources[i], list.item(i), config.detect);
  } else {
    for (SourceConfig& source : config.sources) source.detect = config.detect;
  }
  if (const auto problem = config.validate()) fail_validation(*problem, root, place);
  set_box_frame(config);
  return config;
}

Gripper load_gripper(const std::filesystem::path& file) {
  Gripper gripper;
  read_gripper(load_yaml(file), ConfigPlace{file.string(), ""}, file.stem().string(), gripper);
  return gripper;
}

GripperSetting find_gripper(const std::string& name_or_path, const std::filesystem::path& folder) {
  const auto file = find_config_file(name_or_path, "grippers", folder, ConfigPlace{"gripper", ""});
  GripperSetting setting{"", load_gripper(file)};
  std::error_code error;
  if (std::filesystem::equivalent(file.parent_path(), installed_config_folder() / "grippers", error))
    setting.installed_name = file.stem().string();
  return setting;
}

DetectConfig load_detect_config(const std::filesystem::path& service_file, const std::string& sensor) {
  DetectConfig detect = service_file.empty() ? DetectConfig{} : load_service_config(service_file).detect;
  if (!sensor.empty())
    read_sensor(sensor, ConfigPlace{service_file.empty() ? "sensor" : service_file.string(), "sensor"},
                detect);
  return detect;
}

}  // namespace graspd
