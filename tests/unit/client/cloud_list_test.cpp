// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/cloud_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "client/common/cloud_file.hpp"
#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

TEST(NaturalOrder, NumbersCountByTheirValue) {
  const std::vector<std::string> sorted{"",  "a",       "a1b",      "a1c",      "a2",        "a10",
                                        "b", "frame-1", "frame-01", "frame-2x", "frame-10x", "z"};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t j = 0; j < sorted.size(); ++j) {
      const bool leading_zero = (sorted[i] == "frame-01" && sorted[j] == "frame-1") ||
                                (sorted[j] == "frame-01" && sorted[i] == "frame-1");
      if (leading_zero) continue;
      EXPECT_EQ(natural_less(sorted[i], sorted[j]), i < j) << sorted[i] << " and " << sorted[j];
    }
  }
  EXPECT_NE(natural_less("frame-01", "frame-1"), natural_less("frame-1", "frame-01"));
}

TEST(NaturalOrder, HugeNumbersDoNotOverflow) {
  EXPECT_TRUE(natural_less("x99999999999999999999998", "x99999999999999999999999"));
  EXPECT_TRUE(natural_less("x9", "x10000000000000000000000"));
}

TEST(CloudList, FoldersStandForTheirCloudFilesInNaturalOrder) {
  const TempFolder folder;
  for (const char* name : {"learn10.pcd", "learn2.pcd", "learn1.PLY", "notes.txt", "learn0.pcd.bak"})
    write_bytes(folder / name, "x");
  std::filesystem::create_directory(folder / "deeper.pcd");
  const auto files = list_cloud_files({(folder / "learn10.pcd").string(), folder.path().string()});
  ASSERT_EQ(files.size(), 4u);
  EXPECT_EQ(files[0].filename(), "learn10.pcd") << "as given";
  EXPECT_EQ(files[1].filename(), "learn1.PLY");
  EXPECT_EQ(files[2].filename(), "learn2.pcd");
  EXPECT_EQ(files[3].filename(), "learn10.pcd");
}

TEST(CloudList, WhatIsNotThereIsSaid) {
  const TempFolder folder;
  const auto failure = [](const std::string& path) {
    try {
      (void)list_cloud_files({path});
    } catch (const CloudFileError& error) {
      return std::string(error.what()).substr(path.size());
    }
    return std::string("listed");
  };
  EXPECT_EQ(failure((folder / "none").string()), ": no such file or folder");
  EXPECT_EQ(failure(folder.path().string()), ": holds no PCD or PLY files");
}

}  // namespace
}  // namespace graspd
