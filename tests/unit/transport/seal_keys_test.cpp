// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/seal_keys.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

class SealKeysTest : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text, mode_t mode) {
    const auto path = folder_.write("key", text);
    EXPECT_EQ(chmod(path.c_str(), mode), 0);
    return path;
  }

  static std::string problem(const std::filesystem::path& file) {
    try {
      (void)load_seal_keys(file);
      return "";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }

  const std::string digits_ = "00112233445566778899aabbccddeeff00112233445566778899AABBCCDDEEFF";
  const TempFolder folder_;
};

TEST_F(SealKeysTest, ReadsKeysAndComments) {
  const auto keys =
      load_seal_keys(write("# arm\n\n  " + digits_ + " # new\r\n" + std::string(64, '0'), 0600));
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_EQ(keys[0].bytes[1], 0x11);
  EXPECT_EQ(keys[0].bytes[31], 0xff);
  EXPECT_EQ(keys[1].bytes[0], 0);
}

TEST_F(SealKeysTest, RefusesFilesThatOthersCanRead) {
  for (const mode_t mode : {0644, 0604, 0602, 0601, 0620, 0666}) {
    const auto file = write(digits_, mode);
    EXPECT_EQ(problem(file), "key file '" + file.string() +
                                 "': others may read or change it; remedy: chmod 600 '" + file.string() +
                                 "'");
  }
  for (const mode_t mode : {0600, 0400, 0640, 0440}) EXPECT_EQ(problem(write(digits_, mode)), "");
}

TEST_F(SealKeysTest, SaysWhatIsWrongAndNeverTheKey) {
  EXPECT_NE(problem(folder_ / "none").find("No such file"), std::string::npos);
  EXPECT_NE(problem(folder_.path()).find("not a regular file"), std::string::npos);
  EXPECT_NE(problem(write("# nothing\n", 0600)).find("no key in it"), std::string::npos);
  EXPECT_NE(problem(write(std::string(20000, ' '), 0600)).find("too large"), std::string::npos);
  const std::string bad = problem(write("\n" + digits_.substr(1) + "\n", 0600));
  EXPECT_NE(bad.find("line 2: not a key"), std::string::npos) << bad;
  EXPECT_EQ(bad.find("1223344"), std::string::npos) << "most of a key in a log is a key lost";
  EXPECT_NE(problem(write(digits_ + "0", 0600)), "");
  EXPECT_NE(problem(write(digits_.substr(2) + "xy", 0600)), "");
  std::string many;
  for (int i = 0; i < 17; ++i) many += digits_ + "\n";
  EXPECT_NE(problem(write(many, 0600)).find("more than 16"), std::string::npos);
}

TEST_F(SealKeysTest, APipeDoesNotBlock) {
  const auto pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NE(problem(pipe).find("not a regular file"), std::string::npos);
}

TEST_F(SealKeysTest, MakesKeysOfItsOwn) {
  create_seal_key(folder_ / "a");
  create_seal_key(folder_ / "b");
  struct stat status {};
  ASSERT_EQ(stat((folder_ / "a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0600u);
  EXPECT_NE(load_seal_keys(folder_ / "a").front().bytes, load_seal_keys(folder_ / "b").front().bytes);
  EXPECT_THROW(create_seal_key(folder_ / "a"), std::runtime_error) << "a key is never overwritten";
}

}  // namespace
}  // namespace graspd
