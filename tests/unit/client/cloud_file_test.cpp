// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/cloud_file.hpp"

#include <gtest/gtest.h>
#include <pcl/io/lzf.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>
#include <unistd.h>

#include <cmath>
#include <limits>

#include "client/common/pcd_reader.hpp"
#include "client/common/ply_reader.hpp"
#include "client/simulate/rng.hpp"
#include "tests/unit/client/temp_folder.hpp"

namespace graspd {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// 8 x 6 points with two holes, colours and labels.
LabelledCloud sample() {
  LabelledCloud labelled;
  labelled.cloud.width = 8;
  labelled.cloud.height = 6;
  labelled.cloud.viewpoint = {0.125f, -0.5f, 1.75f};
  Rng rng(1);
  for (std::uint32_t i = 0; i < 48; ++i) {
    const auto value = [&] { return static_cast<float>(rng.uniform(-1, 1)); };
    const bool hole = i == 5 || i == 17;
    labelled.cloud.push_back(hole ? Eigen::Vector3f(kNan, kNan, kNan)
                                  : Eigen::Vector3f(value(), value(), value()));
    labelled.rgb.push_back(0x102030 + i * 0x010203);
    labelled.label.push_back(10 * (i % 5));
  }
  return labelled;
}

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

pcl::PointCloud<pcl::PointXYZRGBL> pcl_sample() {
  const LabelledCloud labelled = sample();
  pcl::PointCloud<pcl::PointXYZRGBL> cloud(8, 6);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    auto& p = cloud[i];
    p.x = labelled.cloud.x[i];
    p.y = labelled.cloud.y[i];
    p.z = labelled.cloud.z[i];
    p.rgba = labelled.rgb[i];
    p.label = labelled.label[i];
  }
  cloud.sensor_origin_ = {0.125f, -0.5f, 1.75f, 0};
  return cloud;
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

  /// The same without a file.
  static std::string parse_failure(const std::string& bytes) {
    try {
      (void)(bytes.starts_with("ply") ? parse_ply(bytes) : parse_pcd(bytes));
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find_first_of("\n\x1b"), std::string::npos) << error.what();
      return error.what();
    }
    return "loaded";
  }

  std::string saved_bytes() {
    save_pcd(folder_ / "good.pcd", sample());
    return read_bytes(folder_ / "good.pcd");
  }

  TempFolder folder_;
};

TEST_F(CloudFile, SavedIsLoadedToTheBit) {
  save_pcd(folder_ / "a.pcd", sample());
  expect_same(load_cloud(folder_ / "a.pcd"), sample());
}

TEST_F(CloudFile, PclReadsWhatWeSave) {
  save_pcd(folder_ / "a.pcd", sample());
  pcl::PointCloud<pcl::PointXYZRGBL> cloud;
  ASSERT_EQ(pcl::io::loadPCDFile((folder_ / "a.pcd").string(), cloud), 0);
  ASSERT_EQ(cloud.size(), 48u);
  EXPECT_EQ(cloud[7].x, sample().cloud.x[7]);
  EXPECT_EQ(cloud[7].label, sample().label[7]);
  EXPECT_EQ(cloud[7].rgba & 0xffffff, sample().rgb[7]);
}

TEST_F(CloudFile, ReadsPclsPcdFiles) {
  const auto cloud = pcl_sample();
  const std::string binary = folder_ / "binary.pcd", compressed = folder_ / "compressed.pcd";
  pcl::PCDWriter writer;
  ASSERT_EQ(writer.writeBinary(binary, cloud), 0);
  ASSERT_EQ(writer.writeBinaryCompressed(compressed, cloud), 0);
  expect_same(load_cloud(binary), sample());
  expect_same(load_cloud(compressed), sample());
}

TEST_F(CloudFile, ReadsAsciiPcd) {
  const std::string path = folder_ / "ascii.pcd";
  ASSERT_EQ(pcl::PCDWriter().writeASCII(path, pcl_sample(), 9), 0);
  expect_same(load_cloud(path), sample());
}

TEST_F(CloudFile, ReadsPly) {
  for (const bool binary : {true, false}) {
    const std::string path = folder_ / (binary ? "binary.ply" : "ascii.ply");
    pcl::PCLPointCloud2 blob;
    auto cloud = pcl_sample();
    cloud[5].x = cloud[5].y = cloud[5].z = 0;  // PLY knows no NaN in text.
    cloud[17] = cloud[5];
    pcl::toPCLPointCloud2(cloud, blob);
    const Eigen::Vector4f origin(0.125f, -0.5f, 1.75f, 0);
    ASSERT_EQ(pcl::PLYWriter().write(path, blob, origin, Eigen::Quaternionf::Identity(), binary, true), 0);
    const LabelledCloud loaded = load_cloud(path);
    ASSERT_EQ(loaded.cloud.size(), 48u);
    for (std::size_t i = 0; i < 48; ++i) EXPECT_NEAR(loaded.cloud.x[i], cloud[i].x, 1e-5) << i;
    EXPECT_EQ(loaded.cloud.viewpoint, Eigen::Vector3f(0.125f, -0.5f, 1.75f));
    EXPECT_EQ(loaded.rgb[9], sample().rgb[9]);
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

TEST_F(CloudFile, LyingHeadersAreRefused) {
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

TEST_F(CloudFile, LyingPlyHeadersAreRefused) {
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

TEST_F(CloudFile, PlysOtherElementsAreSkipped) {
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

TEST_F(CloudFile, BigEndianPly) {
  std::string bytes =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
      "float z\nend_header\n";
  bytes += std::string("\x3f\xc0\0\0\xc0\0\0\0\0\0\0\0", 12);
  EXPECT_EQ(parse_ply(bytes).cloud.point(0), Eigen::Vector3f(1.5f, -2, 0));
}

TEST_F(CloudFile, EveryTruncationIsRefused) {
  ASSERT_EQ(pcl::PCDWriter().writeBinaryCompressed((folder_ / "c.pcd").string(), pcl_sample()), 0);
  for (const std::string& good : {saved_bytes(), read_bytes(folder_ / "c.pcd")}) {
    for (std::size_t n = 0; n < good.size(); ++n) EXPECT_NE(parse_failure(good.substr(0, n)), "loaded") << n;
  }
  EXPECT_EQ(failure(saved_bytes().substr(0, 600)), "ends too early: 402 bytes of points, expected 960");
}

TEST_F(CloudFile, TruncatedTextIsRefused) {
  ASSERT_EQ(pcl::PCDWriter().writeASCII((folder_ / "a.pcd").string(), pcl_sample(), 9), 0);
  ASSERT_EQ(pcl::PLYWriter().write((folder_ / "a.ply").string(), pcl_sample(), false, false), 0);
  for (const char* name : {"a.pcd", "a.ply"}) {
    const std::string good = read_bytes(folder_ / name);
    // The last word may lose digits unseen, never itself.
    const std::size_t last_word = good.find_last_of(" \n", good.size() - 3);
    for (std::size_t n = 0; n < last_word; ++n) EXPECT_NE(parse_failure(good.substr(0, n)), "loaded") << n;
  }
}

TEST_F(CloudFile, TruncatedPlyIsRefused) {
  ASSERT_EQ(pcl::PLYWriter().write((folder_ / "a.ply").string(), pcl_sample(), true, false), 0);
  const std::string good = read_bytes(folder_ / "a.ply");
  for (std::size_t n = 0; n < good.size(); ++n) EXPECT_NE(parse_failure(good.substr(0, n)), "loaded") << n;
}

TEST_F(CloudFile, FlippedBytesNeverCrash) {
  pcl::PCDWriter pcd;
  pcl::PLYWriter ply;
  ASSERT_EQ(pcd.writeASCII((folder_ / "a.pcd").string(), pcl_sample(), 9), 0);
  ASSERT_EQ(pcd.writeBinaryCompressed((folder_ / "c.pcd").string(), pcl_sample()), 0);
  ASSERT_EQ(ply.write((folder_ / "a.ply").string(), pcl_sample(), false, true), 0);
  ASSERT_EQ(ply.write((folder_ / "b.ply").string(), pcl_sample(), true, true), 0);
  saved_bytes();
  Rng rng(2);
  for (const char* name : {"good.pcd", "a.pcd", "c.pcd", "a.ply", "b.ply"}) {
    const std::string good = read_bytes(folder_ / name);
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

TEST_F(CloudFile, WhereItCannotBeWrittenIsSaid) {
  const auto path = folder_ / "no/such/folder.pcd";
  try {
    save_pcd(path, sample());
    FAIL();
  } catch (const CloudFileError& error) {
    EXPECT_EQ(error.what(), path.string() + ": cannot be created: No such file or directory");
  }
  EXPECT_THROW(save_pcd("/dev/full", sample()), CloudFileError);
}

TEST(CloudFileNames, EndingsInAnyCase) {
  EXPECT_TRUE(is_cloud_file("a/b.PCD"));
  EXPECT_TRUE(is_cloud_file("b.ply"));
  EXPECT_FALSE(is_cloud_file("pcd"));
  EXPECT_FALSE(is_cloud_file("a.pcd.txt"));
}

}  // namespace
}  // namespace graspd
