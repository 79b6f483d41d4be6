// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/segmentation_codec.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "tests/unit/transport/allocations.hpp"
#include "tests/unit/transport/message_samples.hpp"

namespace graspd {
namespace {

/// Three points on a line, in segment 1, the second one an edge point, and one of the support.
Surfaces some_surfaces() {
  Surfaces surfaces;
  for (const float x : {0.1f, 0.2f, 0.3f}) surfaces.cloud.push_back({x, -x, 0.7f});
  surfaces.cloud.push_back({0.5f, 0.25f, 0.9f});
  surfaces.is_edge = {0, 1, 0, 0};
  surfaces.segments.of_point = {1, 1, 1, -1};
  surfaces.support.emplace();
  surfaces.support->plane = {{0, 0, -1}, 0.9f};
  surfaces.support->is_support = {0, 0, 0, 1};
  return surfaces;
}

Detection some_detection() {
  Detection detection;
  detection.segments.resize(2);
  detection.segments[0].num_handles = 2;
  SegmentReport& second = detection.segments[1];
  second.centroid = {0.2f, -0.2f, 0.7f};
  second.normal = {0, 0, -1};
  second.major = {1, 0, 0};
  second.num_points = 3;
  second.object = 4;
  second.num_candidates = 9;
  second.failures[static_cast<std::size_t>(Failure::kPalm)] = 2;
  second.failures[static_cast<std::size_t>(Failure::kTooWide)] = 7;
  return detection;
}

Eigen::Vector3d vector(const double (&values)[3]) {
  return {values[0], values[1], values[2]};
}

TEST(SegmentationCodec, EqualsTheGeneratedDecoderOnValidMessages) {
  Random random(70);
  for (int i = 0; i < 500; ++i) {
    const Bytes message = encode(random_segmentation(random));
    ASSERT_EQ(message, raw_bytes(generated_decode<segmentation_t>(message)));
    const auto decoded = decode_segmentation(message);
    ASSERT_TRUE(decoded.has_value());
    ASSERT_EQ(encode(*decoded), message);
  }
}

TEST(SegmentationCodec, RefusesTruncatedLongerAndForeignMessages) {
  Random random(71);
  Bytes message;
  while (message.size() < 700) message = encode(random_segmentation(random));
  for_each_truncation(message,
                      [](const Bytes& part) { EXPECT_FALSE(decode_segmentation(part).has_value()); });
  message.push_back({});
  EXPECT_FALSE(decode_segmentation(message).has_value());
  EXPECT_FALSE(decode_segmentation(raw_bytes(random_handle_list(random))).has_value());
}

TEST(SegmentationCodec, SurvivesEveryCorruption) {
  Random random(72);
  segmentation_t segmentation = random_segmentation(random);
  while (segmentation.num_segments != 1 || segmentation.num_points < 3)
    segmentation = random_segmentation(random);
  const Bytes message = encode(segmentation);
  forget_allocations();
  for_each_corruption(message, [](const Bytes& corrupt) {
    const auto decoded = decode_segmentation(corrupt);
    if (!decoded) return;
    for (std::size_t i = 0; i < static_cast<std::size_t>(decoded->num_points); ++i)
      EXPECT_LT(segmented_point(*decoded, i).segment, decoded->num_segments);
  });
  EXPECT_LT(largest_allocation(), 100'000u);
}

TEST(SegmentationCodec, CountsThatLieAreRefusedOrThrow) {
  Random random(73);
  segmentation_t segmentation = random_segmentation(random);
  while (segmentation.num_points == 0) segmentation = random_segmentation(random);
  const segmentation_t good = segmentation;
  for (const std::int32_t size : {std::numeric_limits<std::int32_t>::min(), -1, 0, 11, 0x7fffffff}) {
    segmentation.data_size = size;
    EXPECT_THROW((void)encode(segmentation), std::invalid_argument);
  }
  segmentation = good;
  segmentation.num_points += 1;  // the encoder does not look at it, the decoder does
  EXPECT_FALSE(decode_segmentation(encode(segmentation)).has_value());
  segmentation = good;
  segmentation.num_segments += 1;
  EXPECT_THROW((void)encode(segmentation), std::invalid_argument);
}

TEST(SegmentationCodec, PointsOfNoSegmentOfTheListAreRefused) {
  segmentation_t segmentation =
      make_segmentation({}, some_detection(), some_surfaces(), Eigen::Isometry3f::Identity());
  ASSERT_TRUE(decode_segmentation(encode(segmentation)).has_value());
  segmentation.data[6] = 2;
  EXPECT_FALSE(decode_segmentation(encode(segmentation)).has_value());
}

TEST(SegmentationCodec, SaysWhatTheSurfacesAre) {
  const HandleListHeader header{11, 12, "CLOUD", "camera", 0, "text", 6, 0.004, true, 0.25, {}};
  const auto decoded = decode_segmentation(
      encode(make_segmentation(header, some_detection(), some_surfaces(), Eigen::Isometry3f::Identity())));
  ASSERT_TRUE(decoded.has_value());
  EXPECT_EQ(decoded->utime, 11);
  EXPECT_EQ(decoded->seq, 12);
  EXPECT_EQ(decoded->source_channel, "CLOUD");
  EXPECT_EQ(decoded->frame_name, "camera");
  EXPECT_EQ(decoded->config_revision, 6);
  EXPECT_EQ(decoded->voxel_size, 0.004);
  ASSERT_EQ(decoded->num_segments, 2);
  EXPECT_EQ(decoded->segments[0].reason, "");
  EXPECT_EQ(decoded->segments[0].num_handles, 2);
  const segment_t& segment = decoded->segments[1];
  EXPECT_EQ(segment.id, 1);
  EXPECT_EQ(segment.object, 4);
  EXPECT_EQ(segment.num_points, 3);
  EXPECT_EQ(segment.num_candidates, 9);
  EXPECT_EQ(segment.reason, name(Failure::kPalm));  // the last check
  ASSERT_EQ(segment.num_failures, 2);
  EXPECT_EQ(segment.failures[0].reason, name(Failure::kTooWide));
  EXPECT_EQ(segment.failures[0].count, 7);
  EXPECT_TRUE(vector(segment.centroid).isApprox(Eigen::Vector3d(0.2, -0.2, 0.7), 1e-6));
  EXPECT_EQ(vector(segment.normal), Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(vector(segment.major_axis), Eigen::Vector3d(1, 0, 0));
}

TEST(SegmentationCodec, PointsKeepTheirPlacesToHalfAStep) {
  const Surfaces surfaces = some_surfaces();
  const segmentation_t segmentation =
      make_segmentation({}, some_detection(), surfaces, Eigen::Isometry3f::Identity());
  ASSERT_EQ(segmentation.num_points, 4);
  EXPECT_NEAR(segmentation.step, 0.55 / 65535, 1e-9);
  for (std::size_t i = 0; i < 4; ++i) {
    const SegmentedPoint point = segmented_point(segmentation, i);
    const Eigen::Vector3d error = point.position - surfaces.cloud.point(i).cast<double>();
    EXPECT_LE(error.cwiseAbs().maxCoeff(), 0.5001 * segmentation.step) << i;
    EXPECT_EQ(point.segment, i < 3 ? 1 : -1);
    EXPECT_EQ(point.is_edge, i == 1);
    EXPECT_EQ(point.is_support, i == 3);
  }
}

TEST(SegmentationCodec, EverythingMovesToTheTargetFrame) {
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.translate(Eigen::Vector3f(1, 2, 3)).rotate(Eigen::AngleAxisf(0.7f, Eigen::Vector3f::UnitX()));
  const Surfaces surfaces = some_surfaces();
  const segmentation_t segmentation = make_segmentation({}, some_detection(), surfaces, T);
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d expected = T.cast<double>() * surfaces.cloud.point(i).cast<double>();
    EXPECT_TRUE(segmented_point(segmentation, i).position.isApprox(expected, 1e-4)) << i;
  }
  const segment_t& segment = segmentation.segments[1];
  EXPECT_TRUE(
      vector(segment.centroid).isApprox((T * Eigen::Vector3f(0.2f, -0.2f, 0.7f)).cast<double>(), 1e-5));
  EXPECT_TRUE(vector(segment.normal).isApprox((T.linear() * -Eigen::Vector3f::UnitZ()).cast<double>(), 1e-5));
  // The support's point is still on the plane.
  const double* plane = segmentation.support_plane;
  EXPECT_NEAR(Eigen::Vector3d(plane[0], plane[1], plane[2]).dot(segmented_point(segmentation, 3).position),
              -plane[3], 1e-4);
}

TEST(SegmentationCodec, TheSupportIsThinnedOut) {
  Surfaces surfaces;
  surfaces.support.emplace();
  for (int i = 0; i < 80; ++i) {
    for (int j = 0; j < 80; ++j)
      surfaces.cloud.push_back(
          {0.003f * static_cast<float>(i) + 0.0015f, 0.003f * static_cast<float>(j) + 0.0015f, 0.901f});
  }
  const std::size_t n = surfaces.cloud.size();
  surfaces.is_edge.assign(n, 0);
  surfaces.is_edge[1] = surfaces.is_edge[2] = 1;
  surfaces.segments.of_point.assign(n, -1);
  surfaces.support->is_support.assign(n, 1);
  surfaces.support->is_support[3] = 0;
  HandleListHeader header;
  header.voxel_m = 0.003;
  const segmentation_t segmentation = make_segmentation(header, {}, surfaces, Eigen::Isometry3f::Identity());
  EXPECT_EQ(segmentation.num_points, 10 * 10 + 2 + 1);
  int edges = 0;
  int others = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(segmentation.num_points); ++i) {
    edges += segmented_point(segmentation, i).is_edge ? 1 : 0;
    others += segmented_point(segmentation, i).is_support ? 0 : 1;
  }
  EXPECT_EQ(edges, 2);
  EXPECT_EQ(others, 1);
}

TEST(SegmentationCodec, OnePlaceAndNoSupport) {
  Surfaces surfaces;
  surfaces.cloud.push_back({1, 2, 3});
  surfaces.is_edge = {1};
  surfaces.segments.of_point = {-1};
  const auto decoded =
      decode_segmentation(encode(make_segmentation({}, {}, surfaces, Eigen::Isometry3f::Identity())));
  ASSERT_TRUE(decoded.has_value());
  EXPECT_EQ(segmented_point(*decoded, 0).position, Eigen::Vector3d(1, 2, 3));
  for (const double c : decoded->support_plane) EXPECT_EQ(c, 0);
}

}  // namespace
}  // namespace graspd
