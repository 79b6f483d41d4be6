// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/config/config_folders.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace graspd {
namespace {

TEST(ConfigFolders, TheInstalledOneIsThere) {
  EXPECT_TRUE(std::filesystem::is_directory(installed_config_folder() / "grippers"));
  EXPECT_TRUE(std::filesystem::is_directory(installed_config_folder() / "sensors"));
}

TEST(ConfigFolders, NamesAndPaths) {
  EXPECT_FALSE(is_path("franka_hand"));
  EXPECT_TRUE(is_path("franka_hand.yaml"));
  EXPECT_TRUE(is_path("./franka_hand"));
}

}  // namespace
}  // namespace graspd
