// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/point_cloud_decoder.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>
#include <map>

#include "service/transport/cloud_encoder.hpp"
#include "tests/unit/transport/allocations.hpp"
#include "tests/unit/transport/cloud_expectations.hpp"

namespace graspd {
namespace {

constexpr std::int32_t kMin32 = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax32 = std::numeric_limits<std::int32_t>::max();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::uint32_t bits_at(const std::vector<std::uint8_t>& data, std::size_t offset) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &data[offset], sizeof(bits));
  return bits;
}

void expect_same(const Frame& frame, const point_cloud_t& oracle) {
  EXPECT_EQ(frame.utime, oracle.utime);
  EXPECT_EQ(frame.seq, oracle.seq);
  EXPECT_EQ(std::string_view(frame.frame_name), oracle.frame_name);
  EXPECT_EQ(frame.cloud.width, oracle.width);
  EXPECT_EQ(frame.cloud.height, oracle.height);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(frame.cloud.viewpoint[axis], static_cast<float>(oracle.viewpoint[axis]));
  }
  std::map<std::string, std::size_t> offset;
  for (const point_field_t& field : oracle.fields)
    offset[field.name] = static_cast<std::size_t>(field.offset);
  const auto n = static_cast<std::size_t>(oracle.width) * static_cast<std::size_t>(oracle.height);
  ASSERT_EQ(frame.cloud.size(), n);
  ASSERT_EQ(frame.cloud.y.size(), n);
  ASSERT_EQ(frame.cloud.z.size(), n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t start = i * static_cast<std::size_t>(oracle.point_step);
    ASSERT_EQ(std::bit_cast<std::uint32_t>(frame.cloud.x[i]), bits_at(oracle.data, start + offset["x"]));
    ASSERT_EQ(std::bit_cast<std::uint32_t>(frame.cloud.y[i]), bits_at(oracle.data, start + offset["y"]));
    ASSERT_EQ(std::bit_cast<std::uint32_t>(frame.cloud.z[i]), bits_at(oracle.data, start + offset["z"]));
  }
}

TEST(PointCloudDecoder, EqualsTheGeneratedDecoderOnValidMessages) {
  Random random(42);
  for (int i = 0; i < 500; ++i) {
    const Bytes message = raw_bytes(random_point_cloud(random, i % 40));
    expect_same(decoded(message), generated_decode<point_cloud_t>(message));
    if (HasFatalFailure()) FAIL() << "message " << i;
  }
}

TEST(PointCloudDecoder, NoPointsAreAFrame) {
  for (const auto& [width, height] : {std::pair{0, 0}, std::pair{0, 480}, std::pair{kMax32, 0}}) {
    point_cloud_t cloud = small_point_cloud();
    cloud.width = width;
    cloud.height = height;
    cloud.fields.clear();
    cloud.num_fields = cloud.point_step = cloud.data_size = 0;
    cloud.data.clear();
    const Frame frame = decoded(raw_bytes(cloud));
    EXPECT_TRUE(frame.cloud.empty());
    EXPECT_EQ(frame.seq, 7);
  }
}

TEST(PointCloudDecoder, RefusesSizesThatContradictEachOther) {
  const auto refuses = [](auto spoil, RefusalReason reason, const std::string& text) {
    point_cloud_t cloud = small_point_cloud();
    spoil(cloud);
    expect_refusal(raw_bytes(cloud), reason, text);
  };
  using enum RefusalReason;
  refuses([](auto& c) { c.width = 2; }, kBadSize,
          "point_cloud_t.data_size: contradicts the other sizes (got 12");
  refuses([](auto& c) { c.width = 0; }, kBadSize, "expected 0 * 1 * 12");
  refuses([](auto& c) { c.width = -1; }, kBadSize, "negative (got -1 * 1");
  refuses([](auto& c) { c.width = c.height = -1; }, kBadSize, "negative");
  refuses([](auto& c) { c.width = c.height = kMin32; }, kBadSize, "negative");
  refuses([](auto& c) { c.width = c.height = kMax32; }, kTooLarge,
          "too many points (got 2147483647 * 2147483647");
  refuses([](auto& c) { c.width = c.height = 1 << 16; }, kTooLarge,
          "expected at most 16000000");  // 2^32 points
  refuses([](auto& c) { c.point_step = 0; }, kBadSize, "expected 1 * 1 * 0");
  refuses([](auto& c) { c.point_step = -12; }, kBadSize, "point_step: negative (got -12");
  refuses([](auto& c) { c.point_step = kMin32; }, kBadSize, "point_step");
  refuses([](auto& c) { c.point_step = kMax32; }, kBadSize, "expected 1 * 1 * 2147483647");
}

TEST(PointCloudDecoder, RefusesALyingDataSize) {
  const Bytes message = raw_bytes(small_point_cloud());
  const std::size_t offset = message.size() - 12 - 4;
  for (const std::int32_t size : {kMin32, -1, 0, 11, 13, 48, kMax32}) {
    Bytes lying = message;
    put(lying, offset, size, 4);
    expect_refusal(lying, RefusalReason::kBadSize, "data_size: contradicts the other sizes");
  }
}

TEST(PointCloudDecoder, RefusesLyingFieldCounts) {
  const Bytes message = raw_bytes(small_point_cloud());
  const std::size_t num_fields = 8 + 16 + 4 + 7 + 24 + 8;
  for (const std::int32_t count : {kMin32, -1, 65, kMax32}) {
    Bytes lying = message;
    put(lying, num_fields, count, 4);
    forget_allocations();
    expect_refusal(lying, RefusalReason::kBadSize, "point_cloud_t.num_fields at byte 67: impossible length");
    EXPECT_LT(largest_allocation(), 4096u);
  }
}

TEST(PointCloudDecoder, RefusesBadFields) {
  const auto refuses = [](auto spoil, RefusalReason reason, const std::string& text) {
    point_cloud_t cloud = small_point_cloud();
    spoil(cloud.fields);
    cloud.num_fields = static_cast<std::int32_t>(cloud.fields.size());
    expect_refusal(raw_bytes(cloud), reason, text);
  };
  using enum RefusalReason;
  refuses([](auto& f) { f.clear(); }, kMissingField, "'x': missing");
  refuses([](auto& f) { f.pop_back(); }, kMissingField, "'z': missing");
  refuses([](auto& f) { f[1].name = "Y"; }, kMissingField, "'y': missing");
  refuses([](auto& f) { f[1].name = "x"; }, kBadField, "fields[1] 'x': there already");
  refuses([](auto& f) { f[2].datatype = point_field_t::UINT32; }, kBadField,
          "'z': wrong datatype (got 6, expected 7");
  refuses([](auto& f) { f[2].datatype = 0; }, kBadField, "unknown datatype (got 0");
  refuses([](auto& f) { f[2].datatype = 9; }, kBadField, "unknown datatype (got 9");
  refuses([](auto& f) { f[2].datatype = -128; }, kBadField, "unknown datatype (got -128");
  refuses([](auto& f) { f[0].count = 0; }, kBadField, "not one value (got count 0");
  refuses([](auto& f) { f[0].count = 3; }, kBadField, "fields[0] 'x': not one value (got count 3");
  refuses([](auto& f) { f[2].offset = 9; }, kBadField,
          "outside the point (got offset 9 of 4 bytes, expected within 12)");
  refuses([](auto& f) { f[2].offset = -1; }, kBadField, "outside the point");
  refuses([](auto& f) { f[2].offset = kMax32; }, kBadField, "outside the point");
  refuses([](auto& f) { f[2].offset = kMin32; }, kBadField, "outside the point");
  refuses(
      [](auto& f) {
        f.push_back({"nan\n\x1b[2J", 9, point_field_t::FLOAT64, 1});
      },
      kBadField, "'nan??[2J'");
}

TEST(PointCloudDecoder, SkipsFieldsThatItDoesNotKnow) {
  point_cloud_t cloud = small_point_cloud();
  cloud.fields.push_back({"rgb", 0, point_field_t::FLOAT32, 1});  // over x: nobody reads it
  cloud.num_fields = 4;
  EXPECT_EQ(decoded(raw_bytes(cloud)).cloud.point(0), Eigen::Vector3f(0.25f, -0.5f, 1.0f));
}

TEST(PointCloudDecoder, RefusesViewpointsThatAreNoPlace) {
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e300, -2e6}) {
    for (int axis = 0; axis < 3; ++axis) {
      point_cloud_t cloud = small_point_cloud();
      cloud.viewpoint[axis] = bad;
      expect_refusal(raw_bytes(cloud), RefusalReason::kBadCalibration,
                     "point_cloud_t.viewpoint: not a place");
    }
  }
}

TEST(PointCloudDecoder, PassesCoordinatesOnWhateverTheyAre) {
  point_cloud_t cloud = small_point_cloud();
  const float point[3] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -0.0f};
  std::memcpy(cloud.data.data(), point, sizeof(point));
  expect_same(decoded(raw_bytes(cloud)), cloud);
}

TEST(PointCloudDecoder, HoldsTheLimits) {
  DecodeLimits limits;
  limits.max_points = 99;
  PointCloud points;
  for (auto* axis : {&points.x, &points.y, &points.z}) axis->assign(100, 0.5f);
  points.width = 100;
  const Bytes message = encode(make_point_cloud({1, 2, "f"}, points));
  expect_refusal(message, RefusalReason::kTooLarge, "width * height: too many points (got 100 * 1", limits);
  limits.max_points = 100;
  EXPECT_EQ(decoded(message, limits).cloud.size(), 100u);
  limits.max_message_bytes = static_cast<int>(message.size()) - 1;
  expect_refusal(message, RefusalReason::kTooLarge, "message: too large", limits);
  EXPECT_EQ(refused(message, limits).seq, 2);
  limits = {};
  limits.max_fields = 2;
  expect_refusal(message, RefusalReason::kBadSize, "num_fields", limits);
}

}  // namespace
}  // namespace graspd
