// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/wire_layout.hpp"

#include <gtest/gtest.h>

#include "bot_core/images_t.hpp"
#include "bot_core/pointcloud2_t.hpp"
#include "bot_core/pointcloud_t.hpp"
#include "drake/lcmt_image_array.hpp"
#include "drake/lcmt_point_cloud.hpp"
#include "graspd/sealed_t.hpp"
#include "sensor_msgs/PointCloud2.hpp"
#include "tests/unit/transport/message_samples.hpp"

namespace graspd {
namespace {

TEST(WireLayout, FingerprintsAreTheGeneratedTypes) {
  EXPECT_EQ(kPointCloudFingerprint, static_cast<std::uint64_t>(point_cloud_t::getHash()));
  EXPECT_EQ(kDepthImageFingerprint, static_cast<std::uint64_t>(depth_image_t::getHash()));
  EXPECT_EQ(kHandleListFingerprint, static_cast<std::uint64_t>(handle_list_t::getHash()));
  EXPECT_EQ(kStatusFingerprint, static_cast<std::uint64_t>(status_t::getHash()));
  EXPECT_EQ(kSealedFingerprint, static_cast<std::uint64_t>(sealed_t::getHash()));
  EXPECT_EQ(kControlFingerprint, static_cast<std::uint64_t>(control_t::getHash()));
  EXPECT_EQ(kSegmentationFingerprint, static_cast<std::uint64_t>(segmentation_t::getHash()));
  EXPECT_EQ(kSegmentationRequestFingerprint, static_cast<std::uint64_t>(segmentation_request_t::getHash()));
}

TEST(WireLayout, FingerprintsOfOthersAreTheirGeneratedTypes) {
  EXPECT_EQ(kLcmtPointCloudFingerprint, static_cast<std::uint64_t>(drake::lcmt_point_cloud::getHash()));
  EXPECT_EQ(kPointcloud2Fingerprint, static_cast<std::uint64_t>(bot_core::pointcloud2_t::getHash()));
  EXPECT_EQ(kPointcloudFingerprint, static_cast<std::uint64_t>(bot_core::pointcloud_t::getHash()));
  EXPECT_EQ(kSensorMsgsPointCloud2Fingerprint,
            static_cast<std::uint64_t>(sensor_msgs::PointCloud2::getHash()));
  EXPECT_EQ(kImagesFingerprint, static_cast<std::uint64_t>(bot_core::images_t::getHash()));
  EXPECT_EQ(kLcmtImageArrayFingerprint, static_cast<std::uint64_t>(drake::lcmt_image_array::getHash()));
}

TEST(WireLayout, FingerprintStartsEveryMessage) {
  Random random(1);
  EXPECT_EQ(type_name(fingerprint(raw_bytes(small_point_cloud())).value()), "point_cloud_t");
  EXPECT_EQ(type_name(fingerprint(raw_bytes(small_depth_image())).value()), "depth_image_t");
  EXPECT_EQ(type_name(fingerprint(raw_bytes(random_handle_list(random))).value()), "handle_list_t");
  EXPECT_EQ(type_name(fingerprint(raw_bytes(random_status(random))).value()), "status_t");
  EXPECT_EQ(type_name(fingerprint(raw_bytes(random_control(random))).value()), "control_t");
  EXPECT_EQ(type_name(fingerprint(raw_bytes(random_segmentation(random))).value()), "segmentation_t");
  EXPECT_EQ(type_name(fingerprint(raw_bytes(random_segmentation_request(random))).value()),
            "segmentation_request_t");
  EXPECT_EQ(type_name(0), "");
  EXPECT_EQ(fingerprint(Bytes(7)), std::nullopt);
}

TEST(WireLayout, DatatypesAreTheContracts) {
  EXPECT_EQ(kFloat32, +point_field_t::FLOAT32);
  EXPECT_EQ(datatype_size(point_field_t::INT8), 1u);
  EXPECT_EQ(datatype_size(point_field_t::UINT8), 1u);
  EXPECT_EQ(datatype_size(point_field_t::INT16), 2u);
  EXPECT_EQ(datatype_size(point_field_t::UINT16), 2u);
  EXPECT_EQ(datatype_size(point_field_t::INT32), 4u);
  EXPECT_EQ(datatype_size(point_field_t::UINT32), 4u);
  EXPECT_EQ(datatype_size(point_field_t::FLOAT32), 4u);
  EXPECT_EQ(datatype_size(point_field_t::FLOAT64), 8u);
  for (const int none : {-128, -1, 0, 9, 127}) EXPECT_EQ(datatype_size(static_cast<std::int8_t>(none)), 0u);
}

}  // namespace
}  // namespace graspd
