// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/web/assets.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

TEST(Assets, AreTheFilesOfAFolderByTheirPaths) {
  const TempFolder folder;
  folder.write("page/index.html", "<p>hello");
  folder.write("page/assets/a-1.js", "1");
  const Assets assets(folder / "page");
  ASSERT_EQ(assets.size(), 2u);
  EXPECT_EQ(assets.find("/")->bytes, "<p>hello");
  EXPECT_EQ(assets.find("/")->content_type, "text/html; charset=utf-8");
  EXPECT_FALSE(assets.find("/")->immutable);
  EXPECT_TRUE(assets.find("/assets/a-1.js")->immutable);
  EXPECT_EQ(assets.find("/assets"), nullptr);
  EXPECT_EQ(assets.find("/nothing"), nullptr);
}

TEST(Assets, LeaveOutLinksThatLeadOut) {
  const TempFolder folder;
  folder.write("secret.txt", "secret");
  folder.write("page/index.html", "");
  std::filesystem::create_symlink(folder / "secret.txt", folder / "page/open.txt");
  std::filesystem::create_symlink("index.html", folder / "page/same.html");
  const Assets assets(folder / "page");
  EXPECT_EQ(assets.find("/open.txt"), nullptr);
  EXPECT_NE(assets.find("/same.html"), nullptr);
}

TEST(Assets, AFolderThatIsNotThereIsSaid) {
  EXPECT_THROW(Assets("/no/such/folder"), std::runtime_error);
  EXPECT_EQ(Assets("").size(), 0u);
}

}  // namespace
}  // namespace graspd
