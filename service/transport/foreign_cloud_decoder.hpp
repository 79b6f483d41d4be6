// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Clouds in types of others -> Frame: Drake's lcmt_point_cloud, bot_core's pointcloud2_t and pointcloud_t,
// dimos's sensor_msgs.PointCloud2.
#pragma once
#include "service/transport/cloud_type.hpp"

namespace graspd {

[[nodiscard]] CloudType lcmt_point_cloud_type();
[[nodiscard]] CloudType pointcloud2_type();
[[nodiscard]] CloudType pointcloud_type();
[[nodiscard]] CloudType sensor_msgs_point_cloud2_type();

}  // namespace graspd
