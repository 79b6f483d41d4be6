// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/cloud_encoder.hpp"

#include <bit>
#include <cstring>
#include <stdexcept>
#include <string>

#include "service/transport/encoding.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

static_assert(std::endian::native == std::endian::little, "packed points and depths are little-endian");

constexpr std::size_t kMaxDataBytes = std::size_t{1} << 28;  // LCM_MAX_MESSAGE_SIZE

void require_length(const char* what, std::size_t length, std::size_t expected) {
  if (length == expected) return;
  throw std::invalid_argument(std::string(what) + ": got " + std::to_string(length) + " values, expected " +
                              std::to_string(expected));
}

std::int32_t checked_data_size(std::size_t bytes) {
  if (bytes > kMaxDataBytes) {
    throw std::invalid_argument("data: got " + std::to_string(bytes) + " bytes, LCM carries at most " +
                                std::to_string(kMaxDataBytes));
  }
  return static_cast<std::int32_t>(bytes);
}

/// One after another, without gaps.
class Packer {
 public:
  explicit Packer(point_cloud_t& message) : message_(message) {}

  void add_field(const char* name, std::int8_t datatype) {
    point_field_t field;
    field.name = name;
    field.offset = message_.point_step;
    field.datatype = datatype;
    field.count = 1;
    message_.fields.push_back(field);
    message_.num_fields = static_cast<std::int32_t>(message_.fields.size());
    message_.point_step += static_cast<std::int32_t>(datatype_size(datatype));
  }

  template <class Value>
  void fill(std::size_t field, std::span<const Value> values) {
    if (values.empty()) return;  // the field need not be there
    auto* target = message_.data.data() + message_.fields[field].offset;
    const auto step = static_cast<std::size_t>(message_.point_step);
    for (std::size_t i = 0; i < values.size(); ++i) std::memcpy(target + i * step, &values[i], sizeof(Value));
  }

 private:
  point_cloud_t& message_;
};

}  // namespace

point_cloud_t make_point_cloud(const FrameHeader& header, const PointCloud& cloud,
                               std::span<const std::uint32_t> rgb, std::span<const std::uint32_t> label) {
  const std::size_t n = cloud.size();
  require_length("cloud", static_cast<std::size_t>(cloud.width) * static_cast<std::size_t>(cloud.height), n);
  if (!rgb.empty()) require_length("rgb", rgb.size(), n);
  if (!label.empty()) require_length("label", label.size(), n);

  point_cloud_t message{};
  message.utime = header.utime;
  message.seq = header.seq;
  message.frame_name = header.frame_name;
  Eigen::Map<Eigen::Vector3d>(message.viewpoint) = cloud.viewpoint.cast<double>();
  message.width = cloud.width;
  message.height = cloud.height;

  Packer packer(message);
  for (const char* name : {"x", "y", "z"}) packer.add_field(name, point_field_t::FLOAT32);
  if (!rgb.empty()) packer.add_field("rgb", point_field_t::UINT32);
  if (!label.empty()) packer.add_field("label", point_field_t::UINT32);
  message.data_size = checked_data_size(n * static_cast<std::size_t>(message.point_step));
  message.data.resize(static_cast<std::size_t>(message.data_size));
  packer.fill<float>(0, cloud.x);
  packer.fill<float>(1, cloud.y);
  packer.fill<float>(2, cloud.z);
  packer.fill(3, rgb);
  packer.fill(rgb.empty() ? 3 : 4, label);
  return message;
}

depth_image_t make_depth_image(const FrameHeader& header, const DepthCamera& camera,
                               std::span<const std::uint16_t> depth) {
  require_length("depth", depth.size(),
                 static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  depth_image_t message{};
  message.utime = header.utime;
  message.seq = header.seq;
  message.frame_name = header.frame_name;
  message.depth_scale = camera.depth_scale_m;
  message.fx = camera.fx;
  message.fy = camera.fy;
  message.cx = camera.cx;
  message.cy = camera.cy;
  message.width = camera.width;
  message.height = camera.height;
  message.data_size = checked_data_size(depth.size_bytes());
  message.data.resize(depth.size_bytes());
  if (!depth.empty()) std::memcpy(message.data.data(), depth.data(), depth.size_bytes());
  return message;
}

void encode(const point_cloud_t& cloud, std::vector<std::byte>& buffer) {
  require_count("point_cloud_t.num_fields", cloud.num_fields, cloud.fields.size());
  require_count("point_cloud_t.data_size", cloud.data_size, cloud.data.size());
  (void)checked_data_size(cloud.data.size());
  encode_message(cloud, buffer);
}

void encode(const depth_image_t& image, std::vector<std::byte>& buffer) {
  require_count("depth_image_t.data_size", image.data_size, image.data.size());
  (void)checked_data_size(image.data.size());
  encode_message(image, buffer);
}

std::vector<std::byte> encode(const point_cloud_t& cloud) {
  return encoded(cloud);
}
std::vector<std::byte> encode(const depth_image_t& image) {
  return encoded(image);
}

}  // namespace graspd
