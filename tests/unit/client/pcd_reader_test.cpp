// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/pcd_reader.hpp"

#include <gtest/gtest.h>
#include <pcl/io/lzf.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include "client/simulate/rng.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/unit/client/sample_cloud.hpp"

namespace graspd {
namespace {

/// The sample as save_pcd writes it.
std::string saved_bytes() {
  const TempFolder folder;
  save_pcd(folder / "good.pcd", sample_cloud());
  return read_bytes(folder / "good.pcd");
}

TEST(PcdReader, LyingHeadersAreRefused) {
  const std::string good = saved_bytes();
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string bytes = good;
    bytes.replace(bytes.find(from), from.size(), to);
    return parse_failure(bytes);
  };
  EXPECT_EQ(with("WIDTH 8", "WIDTH 9"), "the PCD header gives POINTS as 48, expected WIDTH 9 x HEIGHT 6");
  EXPECT_EQ(with("WIDTH 8", "WIDTH 4000000000"), "the PCD header promises too many points");
  EXPECT_EQ(with("WIDTH 8\nHEIGHT 6", "WIDTH 90000000\nHEIGHT 90000000"),
            "the PCD header promises too many points");
  EXPECT_EQ(with("WIDTH 8\n", ""), "the PCD header has no WIDTH");
  EXPECT_EQ(with("POINTS 48", "POINTS -1"), "the PCD header gives POINTS as '-1', expected a count");
  EXPECT_EQ(with("SIZE 4 4 4 4 4", "SIZE 4 4 4 4 9"),
            "the PCD header gives the field label an impossible size, type or count");
  EXPECT_EQ(with("COUNT 1 1", "COUNT 1 0"),
            "the PCD header gives the field y an impossible size, type or count");
  EXPECT_EQ(with("SIZE 4 4 4 4 4", "SIZE 4 4 4"),
            "the PCD header has FIELDS, SIZE, TYPE and COUNT of different lengths");
  EXPECT_EQ(with("COUNT 1 1 1 1 1", "COUNT 65536 1 1 1 1"), "the PCD header has points of more than 64 KiB");
  EXPECT_EQ(with("DATA binary", "DATA braille"),
            "the PCD header gives DATA as 'braille', expected ascii, binary or binary_compressed");
  EXPECT_EQ(with("VIEWPOINT 0.125", "VIEWPOINT nan"), "the PCD header has a VIEWPOINT that is no place");
  EXPECT_EQ(with("FIELDS x y z", "FIELDS a y z"), "has no field x");
  EXPECT_EQ(with("TYPE F F F", "TYPE I F F"), "its field x is not of a floating-point type");
  EXPECT_EQ(with("WIDTH 8\nHEIGHT 6", "WIDTH 8000\nHEIGHT 6000").substr(0, 30),
            "the PCD header gives POINTS as");
  EXPECT_EQ(with("POINTS 48", ""), "loaded") << "older files have none";
}

TEST(PcdReader, HoldsTheLimits) {
  const std::string bytes = saved_bytes();
  CloudFileLimits limits;
  limits.max_points = 47;
  const auto refusal = [&](const std::string& file) {
    try {
      (void)parse_pcd(file, limits);
      return std::string();
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(refusal(bytes), "has 48 points, expected at most 47");
  limits.max_points = 48;
  EXPECT_EQ(refusal(bytes), "");
  // 2 GB of points from 200 kB of file: what a packed file may promise.
  std::string packed =
      "VERSION 0.7\nFIELDS x y z a\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1000\nWIDTH 500000\nHEIGHT 1\n"
      "POINTS 500000\nDATA binary_compressed\n";
  packed += std::string(200'000, '\0');
  limits = {};
  limits.max_unpacked_bytes = 1 << 20;
  EXPECT_EQ(refusal(packed), "unpacks to 2006000000 bytes, expected at most 1048576");
}

TEST(PcdReader, EveryTruncationIsRefused) {
  const TempFolder folder;
  ASSERT_EQ(pcl::PCDWriter().writeBinaryCompressed((folder / "c.pcd").string(), pcl_sample_cloud()), 0);
  for (const std::string& good : {saved_bytes(), read_bytes(folder / "c.pcd")}) {
    for (std::size_t n = 0; n < good.size(); ++n) EXPECT_NE(parse_failure(good.substr(0, n)), "loaded") << n;
  }
  EXPECT_EQ(parse_failure(saved_bytes().substr(0, 600)), "ends too early: 402 bytes of points, expected 960");
}

TEST(CloudReaders, TruncatedTextIsRefused) {
  const TempFolder folder;
  ASSERT_EQ(pcl::PCDWriter().writeASCII((folder / "a.pcd").string(), pcl_sample_cloud(), 9), 0);
  ASSERT_EQ(pcl::PLYWriter().write((folder / "a.ply").string(), pcl_sample_cloud(), false, false), 0);
  for (const char* name : {"a.pcd", "a.ply"}) {
    const std::string good = read_bytes(folder / name);
    // The last word may lose digits unseen, never itself.
    const std::size_t last_word = good.find_last_of(" \n", good.size() - 3);
    for (std::size_t n = 0; n < last_word; ++n) EXPECT_NE(parse_failure(good.substr(0, n)), "loaded") << n;
  }
}

TEST(Lzf, UnpacksWhatPclPacks) {
  Rng rng(3);
  for (int i = 0; i < 300; ++i) {
    std::string plain(static_cast<std::size_t>(1 + rng.index(3000)), '\0');
    const int alphabet = 1 + rng.index(200);
    for (char& c : plain) c = static_cast<char>(rng.index(8) ? plain[0] : rng.index(alphabet));
    std::string packed(2 * plain.size() + 100, '\0');
    packed.resize(pcl::lzfCompress(plain.data(), static_cast<unsigned>(plain.size()), packed.data(),
                                   static_cast<unsigned>(packed.size())));
    std::string unpacked(plain.size(), 'x');
    EXPECT_TRUE(lzf_unpack(packed, unpacked));
    EXPECT_EQ(unpacked, plain);
    std::string too_long(plain.size() + 1, 'x');
    EXPECT_FALSE(lzf_unpack(packed, too_long));
  }
}

TEST(CloudReaders, FlippedBytesNeverCrash) {
  const TempFolder folder;
  pcl::PCDWriter pcd;
  pcl::PLYWriter ply;
  ASSERT_EQ(pcd.writeASCII((folder / "a.pcd").string(), pcl_sample_cloud(), 9), 0);
  ASSERT_EQ(pcd.writeBinaryCompressed((folder / "c.pcd").string(), pcl_sample_cloud()), 0);
  ASSERT_EQ(ply.write((folder / "a.ply").string(), pcl_sample_cloud(), false, true), 0);
  ASSERT_EQ(ply.write((folder / "b.ply").string(), pcl_sample_cloud(), true, true), 0);
  write_bytes(folder / "good.pcd", saved_bytes());
  Rng rng(2);
  for (const char* name : {"good.pcd", "a.pcd", "c.pcd", "a.ply", "b.ply"}) {
    const std::string good = read_bytes(folder / name);
    for (int i = 0; i < 4000; ++i) {
      std::string bytes = good;
      for (int k = 0; k <= rng.index(4); ++k) {
        bytes[static_cast<std::size_t>(rng.index(static_cast<int>(bytes.size())))] =
            static_cast<char>(rng.bits());
      }
      (void)parse_failure(bytes);
    }
  }
}

}  // namespace
}  // namespace graspd
