// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Publishes one cloud, a box on a table seen from above: ../bindings cpp build && g++ publish.cpp -Ibuild
// -llcm -o publish
#include <cstdlib>
#include <cstring>
#include <lcm/lcm-cpp.hpp>

#include "graspd/point_cloud_t.hpp"

int main() {
  graspd::point_cloud_t cloud{};
  cloud.utime = 1;
  cloud.frame_name = "cpp";
  cloud.width = 80;
  cloud.height = 60;
  for (const char* name : {"x", "y", "z"}) {
    cloud.fields.push_back({name, cloud.point_step, graspd::point_field_t::FLOAT32, 1});
    cloud.point_step += 4;
  }
  cloud.num_fields = 3;
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u) {
      const bool on_box = std::abs(u - 40) < 8 && std::abs(v - 30) < 16;
      const float point[3] = {static_cast<float>((u - 40) * 0.003), static_cast<float>((v - 30) * 0.003),
                              on_box ? 0.74f : 0.8f};  // metres from the sensor
      const auto* bytes = reinterpret_cast<const std::uint8_t*>(point);
      cloud.data.insert(cloud.data.end(), bytes, bytes + sizeof(point));
    }
  }
  cloud.data_size = static_cast<std::int32_t>(cloud.data.size());
  lcm::LCM lcm;
  return lcm.good() && lcm.publish("GRASPD_CLOUD", &cloud) == 0 ? 0 : 1;
}
