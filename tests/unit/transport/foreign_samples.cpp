// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/transport/foreign_samples.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "bot_core/pointcloud2_t.hpp"
#include "bot_core/pointcloud_t.hpp"
#include "drake/lcmt_point_cloud.hpp"
#include "sensor_msgs/PointCloud2.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

template <class Message>
void fill_fields(const ForeignCloud& cloud, Message& message) {
  for (const auto& field : cloud.fields) {
    auto& out = message.fields.emplace_back();
    out.name = field.name;
    out.datatype = static_cast<decltype(out.datatype)>(field.datatype);
    out.count = field.count;
  }
}

}  // namespace

const ForeignCloud::Field& ForeignCloud::field(const std::string& name) const {
  return *std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
}

std::size_t ForeignCloud::place(int row, int column, const Field& field) const {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(row_step) +
         static_cast<std::size_t>(column * point_step + field.offset);
}

float ForeignCloud::coordinate(int row, int column, const std::string& name) const {
  const Field& f = field(name);
  std::array<std::uint8_t, 8> bytes{};
  const std::size_t size = f.datatype == kFloat64 ? 8 : 4;
  std::copy_n(data.begin() + static_cast<std::ptrdiff_t>(place(row, column, f)), size, bytes.begin());
  if (big_endian) std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  double wide = 0;
  float narrow = 0;
  std::memcpy(&wide, bytes.data(), 8);
  std::memcpy(&narrow, bytes.data(), 4);
  return f.datatype == kFloat64 ? static_cast<float>(wide) : narrow;
}

void ForeignCloud::set_coordinate(int row, int column, const std::string& name, double value) {
  const Field& f = field(name);
  std::array<std::uint8_t, 8> bytes{};
  const std::size_t size = f.datatype == kFloat64 ? 8 : 4;
  const auto narrow = static_cast<float>(value);
  std::memcpy(bytes.data(), size == 8 ? static_cast<const void*>(&value) : &narrow, size);
  if (big_endian) std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  std::copy_n(bytes.begin(), size, data.begin() + static_cast<std::ptrdiff_t>(place(row, column, f)));
}

ForeignCloud small_foreign_cloud() {
  ForeignCloud cloud;
  for (const char* name : {"x", "y", "z"}) {
    cloud.fields.push_back({name, cloud.point_step, kFloat32, 1});
    cloud.point_step += 4;
  }
  cloud.row_step = cloud.point_step;
  cloud.data.resize(12);
  cloud.set_coordinate(0, 0, "x", 0.25);
  cloud.set_coordinate(0, 0, "y", -0.5);
  cloud.set_coordinate(0, 0, "z", 1);
  return cloud;
}

ForeignCloud random_foreign_cloud(Random& random, int max_side) {
  ForeignCloud cloud;
  cloud.utime = random_int(random, 0, 1'000'000'000);
  cloud.seq = random_int(random, 0, 1000);
  cloud.frame_name = random_text(random);
  cloud.width = random_int(random, 0, max_side);
  cloud.height = random_int(random, 0, 2) == 0 ? random_int(random, 0, max_side) : 1;
  cloud.big_endian = random_int(random, 0, 1) == 1;
  for (const char* name : {"x", "y", "z"})
    cloud.fields.push_back({name, 0, random_int(random, 0, 1) == 1 ? kFloat64 : kFloat32, 1});
  for (int i = random_int(random, 0, 4); i > 0; --i)
    cloud.fields.push_back(
        {i == 1 ? "_" : "intensity", 0, random_int(random, 0, 12), random_int(random, 0, 5)});
  std::shuffle(cloud.fields.begin(), cloud.fields.end(), random);
  for (auto& field : cloud.fields) {
    field.offset = cloud.point_step + random_int(random, 0, 3);
    const auto size = static_cast<int>(datatype_size(static_cast<std::int8_t>(field.datatype)));
    cloud.point_step = field.offset + size * field.count;
  }
  cloud.point_step += random_int(random, 0, 5);
  cloud.row_step = cloud.width * cloud.point_step + (cloud.height > 1 ? random_int(random, 0, 9) : 0);
  if (cloud.width > 0 && cloud.height > 0)
    cloud.data.resize(static_cast<std::size_t>(cloud.row_step) * static_cast<std::size_t>(cloud.height));
  for (auto& byte : cloud.data) byte = static_cast<std::uint8_t>(random_int(random, 0, 255));
  if (!cloud.data.empty() && random_int(random, 0, 1) == 1) {
    for (const char* name : {"x", "y", "z"}) cloud.set_coordinate(0, 0, name, 0);
  }
  return cloud;
}

Bytes as_lcmt_point_cloud(const ForeignCloud& cloud) {
  drake::lcmt_point_cloud message{};
  message.utime = cloud.utime;
  message.frame_name = cloud.frame_name;
  message.width = cloud.width;
  message.height = cloud.height;
  fill_fields(cloud, message);
  for (std::size_t i = 0; i < cloud.fields.size(); ++i)
    message.fields[i].byte_offset = cloud.fields[i].offset;
  message.num_fields = static_cast<std::int32_t>(cloud.fields.size());
  message.flags = cloud.big_endian ? 1 : 2;
  message.point_step = cloud.point_step;
  message.row_step = cloud.row_step;
  message.filler_size = 3;
  message.filler = {1, 2, 3};
  message.data_size = static_cast<std::int64_t>(cloud.data.size());
  message.data = cloud.data;
  return raw_bytes(message);
}

Bytes as_pointcloud2(const ForeignCloud& cloud) {
  bot_core::pointcloud2_t message{};
  message.utime = cloud.utime;
  message.seq = cloud.seq;
  message.frame_id = cloud.frame_name;
  message.width = cloud.width;
  message.height = cloud.height;
  fill_fields(cloud, message);
  for (std::size_t i = 0; i < cloud.fields.size(); ++i) message.fields[i].offset = cloud.fields[i].offset;
  message.nfields = static_cast<std::int32_t>(cloud.fields.size());
  message.is_bigendian = cloud.big_endian ? 1 : 0;
  message.point_step = cloud.point_step;
  message.row_step = cloud.row_step;
  message.data_nbytes = static_cast<std::int32_t>(cloud.data.size());
  message.data = cloud.data;
  return raw_bytes(message);
}

Bytes as_sensor_msgs(const ForeignCloud& cloud) {
  sensor_msgs::PointCloud2 message{};
  message.header.seq = cloud.seq;
  message.header.stamp.sec = static_cast<std::int32_t>(cloud.utime / 1'000'000);
  message.header.stamp.nsec = static_cast<std::int32_t>(cloud.utime % 1'000'000 * 1000 + 999);
  message.header.frame_id = cloud.frame_name;
  message.width = cloud.width;
  message.height = cloud.height;
  fill_fields(cloud, message);
  for (std::size_t i = 0; i < cloud.fields.size(); ++i) message.fields[i].offset = cloud.fields[i].offset;
  message.fields_length = static_cast<std::int32_t>(cloud.fields.size());
  message.is_bigendian = cloud.big_endian ? 1 : 0;
  message.point_step = cloud.point_step;
  message.row_step = cloud.row_step;
  message.data_length = static_cast<std::int32_t>(cloud.data.size());
  message.data = cloud.data;
  return raw_bytes(message);
}

Bytes as_pointcloud(const ForeignCloud& cloud) {
  bot_core::pointcloud_t message{};
  message.utime = cloud.utime;
  message.seq = cloud.seq;
  message.frame_id = cloud.frame_name;
  for (int row = 0; row < cloud.height; ++row) {
    for (int column = 0; column < cloud.width; ++column) {
      message.points.push_back({cloud.coordinate(row, column, "x"), cloud.coordinate(row, column, "y"),
                                cloud.coordinate(row, column, "z")});
    }
  }
  message.n_points = static_cast<std::int32_t>(message.points.size());
  message.n_channels = 2;
  message.channel_names = {"r", "intensity"};
  message.channels.assign(2, std::vector<float>(message.points.size(), 0.5f));
  return raw_bytes(message);
}

}  // namespace graspd
