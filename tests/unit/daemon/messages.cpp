// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/daemon/messages.hpp"

#include <cmath>
#include <string>

#include "service/transport/cloud_encoder.hpp"

namespace graspd {
namespace {

FrameHeader header_of(std::int64_t seq) {
  return {1'000'000 + seq, seq, "camera"};
}

}  // namespace

PointCloud box_on_table() {
  PointCloud cloud;
  for (int i = -100; i <= 100; ++i) {
    for (int j = -100; j <= 100; ++j) {
      const float x = 0.0025f * static_cast<float>(i);
      const float y = 0.0025f * static_cast<float>(j);
      const bool on_box = std::abs(x) <= 0.03f && std::abs(y) <= 0.06f;
      cloud.push_back({x, y, on_box ? 0.52f : 0.6f});
    }
  }
  cloud.width = static_cast<int>(cloud.size());
  return cloud;
}

PointCloud uniform_cloud(std::size_t points, float coordinate) {
  PointCloud cloud;
  cloud.resize(points);
  for (auto* axis : {&cloud.x, &cloud.y, &cloud.z}) axis->assign(points, coordinate);
  cloud.width = static_cast<int>(points);
  return cloud;
}

Bytes cloud_message(std::int64_t seq, const PointCloud& cloud) {
  return encode(make_point_cloud(header_of(seq), cloud));
}

Bytes depth_message(std::int64_t seq, float distance_m) {
  const DepthCamera camera{64, 48, 60, 60, 31.5, 23.5, 0.001};
  const std::vector<std::uint16_t> depth(64 * 48, static_cast<std::uint16_t>(std::lround(distance_m * 1000)));
  return encode(make_depth_image(header_of(seq), camera, depth));
}

}  // namespace graspd
