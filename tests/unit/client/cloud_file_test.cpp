// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/cloud_file.hpp"

#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <unistd.h>

#include <cmath>

#include "tests/support/temp_folder.hpp"
#include "tests/unit/client/sample_cloud.hpp"

namespace graspd {
namespace {

bool same_float(float a, float b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

void expect_same(const LabelledCloud& a, const LabelledCloud& b) {
  EXPECT_EQ(a.cloud.width, b.cloud.width);
  EXPECT_EQ(a.cloud.height, b.cloud.height);
  EXPECT_EQ(a.cloud.viewpoint, b.cloud.viewpoint);
  ASSERT_EQ(a.cloud.size(), b.cloud.size());
  for (std::size_t i = 0; i < a.cloud.size(); ++i) {
    EXPECT_TRUE(same_float(a.cloud.x[i], b.cloud.x[i])) << i;
    EXPECT_TRUE(same_float(a.cloud.y[i], b.cloud.y[i])) << i;
    EXPECT_TRUE(same_float(a.cloud.z[i], b.cloud.z[i])) << i;
  }
  EXPECT_EQ(a.rgb, b.rgb);
  EXPECT_EQ(a.label, b.label);
}

class CloudFile : public testing::Test {
 protected:
  /// The one line that loading a file of these bytes fails with.
  std::string failure(const std::string& bytes, const std::string& name = "bad.pcd") {
    write_bytes(folder_ / name, bytes);
    return failure_of(folder_ / name);
  }

  static std::string failure_of(const std::filesystem::path& path) {
    try {
      (void)load_cloud(path);
    } catch (const CloudFileError& error) {
      const std::string what = error.what();
      EXPECT_TRUE(what.starts_with(path.string() + ": ")) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      return what.substr(path.string().size() + 2);
    }
    return "loaded";
  }

  std::string saved_bytes() {
    save_pcd(folder_ / "good.pcd", sample_cloud());
    return read_bytes(folder_ / "good.pcd");
  }

  TempFolder folder_;
};

TEST_F(CloudFile, SavedIsLoadedToTheBit) {
  save_pcd(folder_ / "a.pcd", sample_cloud());
  expect_same(load_cloud(folder_ / "a.pcd"), sample_cloud());
}

TEST_F(CloudFile, PclReadsWhatWeSave) {
  save_pcd(folder_ / "a.pcd", sample_cloud());
  pcl::PointCloud<pcl::PointXYZRGBL> cloud;
  ASSERT_EQ(pcl::io::loadPCDFile((folder_ / "a.pcd").string(), cloud), 0);
  ASSERT_EQ(cloud.size(), 48u);
  EXPECT_EQ(cloud[7].x, sample_cloud().cloud.x[7]);
  EXPECT_EQ(cloud[7].label, sample_cloud().label[7]);
  EXPECT_EQ(cloud[7].rgba & 0xffffff, sample_cloud().rgb[7]);
}

TEST_F(CloudFile, ReadsPclsPcdFiles) {
  const auto cloud = pcl_sample_cloud();
  const std::string binary = folder_ / "binary.pcd", compressed = folder_ / "compressed.pcd";
  pcl::PCDWriter writer;
  ASSERT_EQ(writer.writeBinary(binary, cloud), 0);
  ASSERT_EQ(writer.writeBinaryCompressed(compressed, cloud), 0);
  expect_same(load_cloud(binary), sample_cloud());
  expect_same(load_cloud(compressed), sample_cloud());
}

TEST_F(CloudFile, ReadsAsciiPcd) {
  const std::string path = folder_ / "ascii.pcd";
  ASSERT_EQ(pcl::PCDWriter().writeASCII(path, pcl_sample_cloud(), 9), 0);
  expect_same(load_cloud(path), sample_cloud());
}

TEST_F(CloudFile, ReadsPly) {
  for (const bool binary : {true, false}) {
    const std::string path = folder_ / (binary ? "binary.ply" : "ascii.ply");
    pcl::PCLPointCloud2 blob;
    auto cloud = pcl_sample_cloud();
    cloud[5].x = cloud[5].y = cloud[5].z = 0;  // PLY knows no NaN in text.
    cloud[17] = cloud[5];
    pcl::toPCLPointCloud2(cloud, blob);
    const Eigen::Vector4f origin(0.125f, -0.5f, 1.75f, 0);
    ASSERT_EQ(pcl::PLYWriter().write(path, blob, origin, Eigen::Quaternionf::Identity(), binary, true), 0);
    const LabelledCloud loaded = load_cloud(path);
    ASSERT_EQ(loaded.cloud.size(), 48u);
    for (std::size_t i = 0; i < 48; ++i) EXPECT_NEAR(loaded.cloud.x[i], cloud[i].x, 1e-5) << i;
    EXPECT_EQ(loaded.cloud.viewpoint, Eigen::Vector3f(0.125f, -0.5f, 1.75f));
    EXPECT_EQ(loaded.rgb[9], sample_cloud().rgb[9]);
  }
}

TEST_F(CloudFile, UnorganizedAndEmptyCloudsAreClouds) {
  LabelledCloud line;
  line.cloud.push_back({1, 2, 3});
  line.cloud.width = 1;
  save_pcd(folder_ / "one.pcd", line);
  expect_same(load_cloud(folder_ / "one.pcd"), line);
  save_pcd(folder_ / "none.pcd", LabelledCloud{});
  EXPECT_EQ(load_cloud(folder_ / "none.pcd").cloud.size(), 0u);
}

TEST_F(CloudFile, WhatIsNotThereIsSaid) {
  EXPECT_EQ(failure_of(folder_ / "missing.pcd"), "no such file");
  EXPECT_EQ(failure_of(folder_.path()), "is a folder, expected a PCD or PLY file");
  EXPECT_EQ(failure(""), "is empty");
  EXPECT_EQ(failure("PNG and so on"), "is neither a PCD nor a PLY file");
  if (geteuid() == 0) return;  // Root reads everything.
  saved_bytes();
  std::filesystem::permissions(folder_ / "good.pcd", std::filesystem::perms::none);
  EXPECT_EQ(failure_of(folder_ / "good.pcd"), "cannot be opened: Permission denied");
}

TEST_F(CloudFile, WhereItCannotBeWrittenIsSaid) {
  const auto path = folder_ / "no/such/folder.pcd";
  try {
    save_pcd(path, sample_cloud());
    FAIL();
  } catch (const CloudFileError& error) {
    EXPECT_EQ(error.what(), path.string() + ": cannot be created: No such file or directory");
  }
  EXPECT_THROW(save_pcd("/dev/full", sample_cloud()), CloudFileError);
}

TEST(CloudFileNames, EndingsInAnyCase) {
  EXPECT_TRUE(is_cloud_file("a/b.PCD"));
  EXPECT_TRUE(is_cloud_file("b.ply"));
  EXPECT_FALSE(is_cloud_file("pcd"));
  EXPECT_FALSE(is_cloud_file("a.pcd.txt"));
}

}  // namespace
}  // namespace graspd
