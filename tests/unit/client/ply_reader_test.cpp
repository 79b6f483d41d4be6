// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/ply_reader.hpp"

#include <gtest/gtest.h>
#include <pcl/io/ply_io.h>

#include <cmath>

#include "tests/support/temp_folder.hpp"
#include "tests/unit/client/sample_cloud.hpp"

namespace graspd {
namespace {

TEST(PlyReader, LyingHeadersAreRefused) {
  const auto ply = [](const std::string& header) {
    return parse_failure("ply\n" + header + "end_header\n1 2 3\n");
  };
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  EXPECT_EQ(ply("format ascii 1.0\nelement vertex 1\n" + xyz), "loaded");
  EXPECT_EQ(ply("element vertex 1\n" + xyz), "the PLY header has no format");
  EXPECT_EQ(ply("format morse 1.0\n"), "the PLY header gives the format as 'morse'");
  EXPECT_EQ(ply("format ascii 1.0\n"), "the PLY header has no element vertex");
  EXPECT_EQ(ply("format ascii 1.0\nelement vertex 1\nproperty float x\n"), "has no property y");
  EXPECT_EQ(ply("format ascii 1.0\nelement vertex 1\nproperty half x\n"),
            "the PLY header has the type 'half'");
  EXPECT_EQ(ply("format ascii 1.0\nelement vertex 99999999999\n"),
            "the PLY header promises '99999999999' of vertex");
  EXPECT_EQ(ply("format ascii 1.0\nelement vertex 90000000\n" + xyz),
            "ends too early: 6 bytes of points, expected 540000000");
  EXPECT_EQ(ply("format ascii 1.0\nelement vertex 1\nproperty uchar x\nproperty uchar y\nproperty char z\n"),
            "loaded");
  EXPECT_EQ(
      ply("format ascii 1.0\nelement face 90000000\nproperty list uchar int v\nelement vertex 1\n" + xyz),
      "damaged: a list of impossible length");
  EXPECT_EQ(ply("format ascii 1.0\nelement vertex 1\nproperty list uint int v\n" + xyz),
            "ends too early: 6 bytes of points, expected 8");
  EXPECT_EQ(parse_failure("ply\nformat ascii 1.0\nelement vertex 1\n" + xyz + "end_header\n1 two\x1b 3\n"),
            "damaged: 'two?' is no number of its property's type");
}

TEST(PlyReader, OtherElementsAreSkipped) {
  const LabelledCloud cloud = parse_ply(
      "ply\nformat ascii 1.0\ncomment made by hand\nelement face 2\nproperty list uchar int v\nelement "
      "vertex 2\n"
      "property double x\nproperty float y\nproperty float z\nproperty list uchar float w\nproperty uchar "
      "red\n"
      "property uchar green\nproperty uchar blue\nproperty int label\nend_header\n"
      "3 0 1 2\n0\n1.5 2 3 2 9 9 255 128 1 20\n-4 5 nan 0 0 0 2 -1\n");
  ASSERT_EQ(cloud.cloud.size(), 2u);
  EXPECT_EQ(cloud.cloud.point(0), Eigen::Vector3f(1.5f, 2, 3));
  EXPECT_EQ(cloud.cloud.x[1], -4);
  EXPECT_TRUE(std::isnan(cloud.cloud.z[1]));
  EXPECT_EQ(cloud.rgb, (std::vector<std::uint32_t>{0xff8001, 0x000002}));
  EXPECT_EQ(cloud.label, (std::vector<std::uint32_t>{20, 0}));
}

/// Found by the fuzzer: no comparison with a number holds for NaN.
TEST(PlyReader, ViewpointsThatAreNoPlace) {
  for (const std::string place : {"nan 0 0", "0 -nan 0", "inf 0 0", "0 0 -inf", "0 1e7 0"}) {
    const std::string file =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        "element camera 1\nproperty float view_px\nproperty float view_py\nproperty float "
        "view_pz\nend_header\n"
        "1 2 3\n" +
        place + "\n";
    EXPECT_THROW((void)parse_ply(file), std::runtime_error) << place;
  }
}

TEST(PlyReader, HoldsTheLimit) {
  CloudFileLimits limits;
  limits.max_points = 1;
  const std::string file =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float "
      "z\nend_header\n"
      "1 2 3\n4 5 6\n";
  EXPECT_EQ(parse_ply(file).cloud.size(), 2u);
  EXPECT_THROW((void)parse_ply(file, limits), std::runtime_error);
}

TEST(PlyReader, ReadsBigEndian) {
  std::string bytes =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
      "float z\nend_header\n";
  bytes += std::string("\x3f\xc0\0\0\xc0\0\0\0\0\0\0\0", 12);
  EXPECT_EQ(parse_ply(bytes).cloud.point(0), Eigen::Vector3f(1.5f, -2, 0));
}

TEST(PlyReader, EveryTruncationIsRefused) {
  const TempFolder folder;
  ASSERT_EQ(pcl::PLYWriter().write((folder / "a.ply").string(), pcl_sample_cloud(), true, false), 0);
  const std::string good = read_bytes(folder / "a.ply");
  for (std::size_t n = 0; n < good.size(); ++n) EXPECT_NE(parse_failure(good.substr(0, n)), "loaded") << n;
}

}  // namespace
}  // namespace graspd
