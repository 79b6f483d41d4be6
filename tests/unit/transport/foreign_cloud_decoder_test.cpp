// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/foreign_cloud_decoder.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "service/transport/wire_layout.hpp"
#include "tests/unit/transport/allocations.hpp"
#include "tests/unit/transport/cloud_expectations.hpp"
#include "tests/unit/transport/foreign_samples.hpp"

namespace graspd {
namespace {

constexpr std::int32_t kMin32 = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax32 = std::numeric_limits<std::int32_t>::max();

struct Type {
  const char* name;
  Bytes (*encode)(const ForeignCloud&);
  bool has_seq;
  bool is_packed;
};

class ForeignCloudDecoder : public testing::TestWithParam<Type> {
 protected:
  static Bytes small() { return GetParam().encode(small_foreign_cloud()); }
};

void expect_same(const Frame& frame, const ForeignCloud& cloud) {
  std::size_t i = 0;
  for (int row = 0; row < cloud.height; ++row) {
    for (int column = 0; column < cloud.width; ++column, ++i) {
      const float want[3] = {cloud.coordinate(row, column, "x"), cloud.coordinate(row, column, "y"),
                             cloud.coordinate(row, column, "z")};
      const float got[3] = {frame.cloud.x[i], frame.cloud.y[i], frame.cloud.z[i]};
      const bool missing = want[0] == 0 && want[1] == 0 && want[2] == 0;
      for (int axis = 0; axis < 3; ++axis) {
        if (missing || std::isnan(want[axis])) {
          ASSERT_TRUE(std::isnan(got[axis])) << i;
        } else {
          ASSERT_EQ(std::bit_cast<std::uint32_t>(got[axis]), std::bit_cast<std::uint32_t>(want[axis])) << i;
        }
      }
    }
  }
}

TEST_P(ForeignCloudDecoder, EqualsWhatGeneratedCodeEncoded) {
  Random random(42);
  for (int i = 0; i < 300; ++i) {
    const ForeignCloud cloud = random_foreign_cloud(random, i % 30);
    const Frame frame = decoded(GetParam().encode(cloud));
    EXPECT_EQ(frame.utime, cloud.utime);
    EXPECT_EQ(frame.seq, GetParam().has_seq ? cloud.seq : -1);
    EXPECT_EQ(std::string_view(frame.frame_name), cloud.frame_name);
    EXPECT_TRUE(frame.cloud.viewpoint.isZero(0));
    ASSERT_EQ(frame.cloud.size(), static_cast<std::size_t>(cloud.width * cloud.height));
    EXPECT_EQ(frame.cloud.width, GetParam().is_packed ? cloud.width : cloud.width * cloud.height);
    expect_same(frame, cloud);
    if (HasFatalFailure()) FAIL() << "message " << i;
  }
}

TEST_P(ForeignCloudDecoder, TakesTheViewpointFromTheConfiguration) {
  const CloudInput input{{0.5f, 0, 1.25f}, {}};
  const auto result = decode_cloud(small(), {}, input);
  EXPECT_EQ(std::get<Frame>(result).cloud.viewpoint, input.viewpoint_m);
}

TEST_P(ForeignCloudDecoder, RefusesEveryTruncationAndTrailingBytes) {
  Bytes message = small();
  for_each_truncation(message, [](const Bytes& part) {
    EXPECT_EQ(name(refused(part).reason), name(RefusalReason::kTruncated)) << part.size();
    EXPECT_TRUE(check_cloud(part, {}));
    const FrameHeader header = peek_header(part, {});
    EXPECT_EQ(refused(part).utime, header.utime);
    EXPECT_EQ(refused(part).seq, header.seq);
    EXPECT_EQ(refused(part).frame_name, header.frame_name);
  });
  message.push_back({});
  expect_refusal(message, RefusalReason::kTrailingBytes, std::string(GetParam().name) + ".end");
}

TEST_P(ForeignCloudDecoder, DecodesOrRefusesEveryCorruption) {
  forget_allocations();
  for_each_corruption(small(), [](const Bytes& corrupt) {
    const auto result = decode_cloud(corrupt, {});
    const auto* refusal = std::get_if<Refusal>(&result);
    const std::optional<Refusal> checked = check_cloud(corrupt, {});
    ASSERT_EQ(checked.has_value(), refusal != nullptr);
    if (refusal != nullptr) {
      ASSERT_FALSE(refusal->text.empty());
      ASSERT_EQ(refusal->text, checked->text);
      ASSERT_EQ(refusal->utime, peek_header(corrupt, {}).utime);
    } else {
      ASSERT_LE(std::get<Frame>(result).cloud.size(), 12u);
    }
  });
  EXPECT_LT(largest_allocation(), 100'000u);
}

TEST_P(ForeignCloudDecoder, DecodesOrRefusesRandomBytesBehindItsFingerprint) {
  Random random(5);
  const Bytes message = small();
  for (int i = 0; i < 10'000; ++i) {
    Bytes noise = message;
    noise.resize(static_cast<std::size_t>(random_int(random, 8, 200)));
    for (std::size_t k = 8; k < noise.size(); ++k) {
      if (random_int(random, 0, 2) == 0) noise[k] = static_cast<std::byte>(random_int(random, 0, 255));
    }
    (void)decode_cloud(noise, {});
  }
}

TEST_P(ForeignCloudDecoder, RefusesBadFieldsAndSizes) {
  if (!GetParam().is_packed) return;  // its layout is fixed
  const auto refuses = [](auto spoil, RefusalReason reason, const std::string& text) {
    ForeignCloud cloud = small_foreign_cloud();
    spoil(cloud);
    expect_refusal(GetParam().encode(cloud), reason, text);
  };
  using enum RefusalReason;
  refuses([](auto& c) { c.fields.pop_back(); }, kMissingField, "'z': missing");
  refuses([](auto& c) { c.fields[1].name = "x"; }, kBadField, "'x': there twice");
  refuses([](auto& c) { c.fields[2].datatype = 6; }, kBadField, "'z': wrong datatype (got 6, expected 7");
  refuses([](auto& c) { c.fields[2].count = 2; }, kBadField, "not one value (got 2");
  refuses([](auto& c) { c.fields[2].offset = 9; }, kBadField,
          "outside the point (got 9, expected 4 bytes within 12");
  refuses([](auto& c) { c.fields[2].offset = -4; }, kBadField, "outside the point");
  refuses([](auto& c) { c.fields[2].offset = kMax32; }, kBadField, "outside the point");
  refuses([](auto& c) { c.fields[2].datatype = kFloat64; }, kBadField, "expected 8 bytes within 12");
  refuses([](auto& c) { c.point_step = 0; }, kBadSize, "point_step: not the size of a point (got 0");
  refuses([](auto& c) { c.point_step = kMin32; }, kBadSize, "point_step");
  refuses([](auto& c) { c.width = 2; }, kBadSize, "data: contradicts the other sizes (got 12");
  refuses([](auto& c) { c.width = 0; }, kBadSize, "expected none for 0 * 1");
  refuses([](auto& c) { c.width = -1; }, kBadSize, "negative (got -1 * 1");
  refuses([](auto& c) { c.height = kMin32; }, kBadSize, "negative");
  refuses([](auto& c) { c.width = c.height = kMax32; }, kTooLarge, "too many points");
  refuses([](auto& c) { c.height = 2; }, kBadSize, "data: contradicts");
  refuses([](auto& c) { c.height = 2, c.row_step = 11; }, kBadSize, "row_step: contradicts");
  refuses([](auto& c) { c.height = 2, c.row_step = kMax32; }, kBadSize, "row_step: contradicts");
  refuses([](auto& c) { c.data.resize(13); }, kBadSize, "data: contradicts the other sizes (got 13");
}

TEST_P(ForeignCloudDecoder, TakesLayoutsThatPublishersReallySend) {
  if (!GetParam().is_packed) return;
  ForeignCloud cloud = small_foreign_cloud();
  cloud.row_step = 0;  // of one row it says nothing
  EXPECT_EQ(decoded(GetParam().encode(cloud)).cloud.point(0), Eigen::Vector3f(0.25f, -0.5f, 1.0f));
  cloud.row_step = 16;
  cloud.data.resize(16);  // one row with bytes behind it
  EXPECT_EQ(decoded(GetParam().encode(cloud)).cloud.size(), 1u);
  cloud.height = 2;
  cloud.data.resize(28);  // the last row without them
  EXPECT_EQ(decoded(GetParam().encode(cloud)).cloud.size(), 2u);
  cloud.data.resize(32);
  EXPECT_EQ(decoded(GetParam().encode(cloud)).cloud.size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(Types, ForeignCloudDecoder,
                         testing::Values(Type{"lcmt_point_cloud", as_lcmt_point_cloud, false, true},
                                         Type{"pointcloud2_t", as_pointcloud2, true, true},
                                         Type{"sensor_msgs.PointCloud2", as_sensor_msgs, true, true},
                                         Type{"pointcloud_t", as_pointcloud, true, false}),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           std::erase(name, '.');
                           return name;
                         });

TEST(ForeignCloudDecoderSizes, LyingCountsAreNotAllocatedFor) {
  Bytes message = as_lcmt_point_cloud(small_foreign_cloud());
  const std::size_t data_size = message.size() - 12 - 8;
  for (const std::int64_t size : {std::numeric_limits<std::int64_t>::min(), std::int64_t{-1}}) {
    put(message, data_size, size, 8);
    expect_refusal(message, RefusalReason::kBadSize, "lcmt_point_cloud.data_size");
  }
  for (const std::int64_t size : {std::int64_t{13}, std::numeric_limits<std::int64_t>::max()}) {
    put(message, data_size, size, 8);
    forget_allocations();
    expect_refusal(message, RefusalReason::kTruncated, "lcmt_point_cloud.data_size");
    EXPECT_LT(largest_allocation(), 4096u);
  }
  message = as_pointcloud(small_foreign_cloud());
  const std::size_t n_points = 8 + 8 + 4 + 4 + 6;
  for (const std::int32_t count : {2, kMax32}) {
    put(message, n_points, count, 4);
    forget_allocations();
    (void)refused(message);
    EXPECT_LT(largest_allocation(), 4096u);
  }
}

}  // namespace
}  // namespace graspd
