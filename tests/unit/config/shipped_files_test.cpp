// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The files in config/ load, say what they should, and do not drift from the code.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "service/config/config_folders.hpp"
#include "service/config/service_config.hpp"

namespace graspd {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::vector<std::filesystem::path> yaml_files(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(installed_config_folder() / folder)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  return files;
}

TEST(ShippedFiles, ServiceFileIsTheDefaultsWrittenOut) {
  // To renew it: graspd --print-config > config/graspd.yaml
  EXPECT_EQ(text_of(installed_config_folder() / "graspd.yaml"), print(ServiceConfig{}));
}

TEST(ShippedFiles, ServiceFileLoads) {
  EXPECT_EQ(print(load_service_config(installed_config_folder() / "graspd.yaml")), print(ServiceConfig{}));
}

TEST(ShippedFiles, GrippersLoadUnderTheirFilesNames) {
  EXPECT_GE(yaml_files("grippers").size(), 5u);
  for (const auto& file : yaml_files("grippers")) EXPECT_EQ(load_gripper(file).name, file.stem().string());
}

TEST(ShippedFiles, ThePapersGripperIsTheDefault) {
  ServiceConfig config;
  config.sources[0].gripper = find_gripper("paper_80mm", "");
  EXPECT_EQ(print(config), print(ServiceConfig{}));
  config.sources[0].gripper.installed_name.clear();
  ServiceConfig defaults;
  defaults.sources[0].gripper.installed_name.clear();
  EXPECT_EQ(print(config), print(defaults));
}

TEST(ShippedFiles, SensorsLoad) {
  EXPECT_GE(yaml_files("sensors").size(), 3u);
  for (const auto& file : yaml_files("sensors")) {
    const DetectConfig detect = load_detect_config("", file.string());
    EXPECT_LT(detect.workspace.min_range_m, detect.workspace.max_range_m);
  }
}

TEST(ShippedFiles, TheReadmeNamesEveryGripperAndSensor) {
  const std::string readme = text_of(installed_config_folder() / "README.md");
  for (const char* folder : {"grippers", "sensors"}) {
    for (const auto& file : yaml_files(folder)) {
      std::string name = "`";
      name.append(file.stem().string()).append("`");
      EXPECT_NE(readme.find(name), std::string::npos) << name;
    }
  }
}

}  // namespace
}  // namespace graspd
