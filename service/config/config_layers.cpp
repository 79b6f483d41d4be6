// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Command line and control messages on top of a service file.
#include <filesystem>
#include <string>

#include "service/config/config_folders.hpp"
#include "service/config/field_reader.hpp"
#include "service/config/read_service_config.hpp"
#include "service/config/service_config.hpp"
#include "service/config/yaml_file.hpp"

namespace graspd {
namespace {

const ConfigPlace kOverrides{"overrides", ""};

/// A copy without aliases, which in a few lines of YAML can stand for more nodes than any memory holds.
class BoundedCopy {
 public:
  explicit BoundedCopy(const ConfigPlace& place) : place_(place) {}

  YAML::Node operator()(const YAML::Node& node) {
    constexpr int kMostNodes = 20'000;
    if (++nodes_ > kMostNodes) place_.fail("too many values", "", "at most " + std::to_string(kMostNodes));
    if (node.IsMap()) {
      YAML::Node copy(YAML::NodeType::Map);
      for (const auto& entry : node) copy.force_insert((*this)(entry.first), (*this)(entry.second));
      return copy;
    }
    if (node.IsSequence()) {
      YAML::Node copy(YAML::NodeType::Sequence);
      for (const auto& item : node) copy.push_back((*this)(item));
      return copy;
    }
    if (!node.IsScalar()) return YAML::Node(YAML::NodeType::Null);
    YAML::Node copy(node.Scalar());
    copy.SetTag(node.Tag());
    return copy;
  }

 private:
  const ConfigPlace& place_;
  int nodes_ = 0;
};

YAML::Node source_named(const YAML::Node& sources, const std::string& name) {
  for (const auto& source : sources) {
    const YAML::Node found = source.IsMap() ? find(source, "name") : YAML::Node(YAML::NodeType::Undefined);
    if (found && found.IsScalar() && found.Scalar() == name) return source;
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

void merge_map(YAML::Node base, const YAML::Node& top);

/// Sources are told by their names; one that is new goes to the end.
void merge_sources(YAML::Node base, const YAML::Node& top) {
  const ConfigPlace place = kOverrides.child("sources");
  for (std::size_t i = 0; i < list_length(top, place); ++i) {
    const YAML::Node name = top[i].IsMap() ? find(top[i], "name") : YAML::Node(YAML::NodeType::Undefined);
    if (!name || !name.IsScalar()) place.item(i).fail("no name", "", "the name of the source that is meant");
    const YAML::Node source = source_named(base, name.Scalar());
    if (source && source.IsMap()) {
      merge_map(source, top[i]);
    } else {
      base.push_back(top[i]);
    }
  }
}

/// Maps are merged; anything else in `top`, and a gripper's keys, which are all or none, replaces what is
/// there.
void merge_map(YAML::Node base, const YAML::Node& top) {
  for (const auto& entry : top) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : describe(entry.first);
    const YAML::Node old = find(base, key);
    if (key == "sources" && old && old.IsSequence()) {
      merge_sources(old, entry.second);
    } else if (key != "gripper" && old && old.IsMap() && entry.second.IsMap()) {
      merge_map(old, entry.second);
    } else {
      base[key] = entry.second;
    }
  }
}

YAML::Node parse_overrides(const std::string& text) {
  if (text.size() > kMaxOverridesBytes) {
    kOverrides.fail("too large", std::to_string(text.size()) + " bytes",
                    "at most " + std::to_string(kMaxOverridesBytes) + " bytes");
  }
  const YAML::Node root = parse_yaml(text, kOverrides);
  if (root.IsNull() || !root.IsDefined()) return YAML::Node(YAML::NodeType::Map);
  if (!root.IsMap()) kOverrides.fail("wrong type", describe(root), "a map");
  return BoundedCopy(kOverrides)(root);
}

/// The file's tree, with at least the built-in source in it, for others to name.
YAML::Node file_root(const std::filesystem::path& file) {
  YAML::Node root = file.empty() ? YAML::Node() : load_yaml(file);
  if (!root.IsDefined() || root.IsNull()) root = YAML::Node(YAML::NodeType::Map);
  if (root.IsMap() && !find(root, "sources")) {
    const SourceConfig built_in;
    YAML::Node source(YAML::NodeType::Map);
    source["name"] = built_in.name;
    source["channel"] = built_in.channel;
    root["sources"].push_back(source);
  }
  return root;
}

void apply_command_line(YAML::Node root, const ConfigLayers& layers) {
  if (layers.workers) root["workers"] = *layers.workers;
  if (layers.threads) root["threads"] = *layers.threads;
  if (!layers.lcm_url.empty()) root["lcm"]["url"] = layers.lcm_url;
  if (layers.gripper.empty()) return;
  // A path on the command line is relative to where the command is given.
  const bool path = is_path(layers.gripper);
  const std::string gripper = path ? std::filesystem::absolute(layers.gripper).string() : layers.gripper;
  for (YAML::Node source : root["sources"])
    if (source.IsMap()) source["gripper"] = gripper;
}

}  // namespace

ServiceConfig load_layers(const ConfigLayers& layers) {
  const ConfigPlace place{layers.file.empty() ? "built-in configuration" : layers.file.string(), ""};
  const YAML::Node from_file = file_root(layers.file);
  // What is not as it must be in the file is told before anything is put on top of it.
  if (!layers.file.empty()) (void)read_service_config(from_file, place);
  const YAML::Node root = BoundedCopy(place)(from_file);
  apply_command_line(root, layers);
  merge_map(root, parse_overrides(layers.overrides));
  return read_service_config(root, place);
}

std::string merge_overrides(const std::string& overrides, const std::string& text) {
  YAML::Node merged = parse_overrides(overrides);
  merge_map(merged, parse_overrides(text));
  if (merged.size() == 0) return {};
  std::string result = YAML::Dump(merged);
  if (result.size() > kMaxOverridesBytes)
    kOverrides.fail("too large together", "", "fewer settings, or a reset");
  return result;
}

}  // namespace graspd
