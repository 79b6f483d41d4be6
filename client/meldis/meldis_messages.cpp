// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/meldis/meldis_messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "client/meldis/gripper_mesh.hpp"
#include "service/transport/segmentation_codec.hpp"

namespace graspd {
namespace {

// Values of Drake's types.
constexpr std::int8_t kMesh = 4;
constexpr std::int8_t kUint32 = 6;
constexpr std::int8_t kFloat32 = 7;
constexpr std::int64_t kStrictlyFinite = 2;
constexpr int kPointBytes = 16;

using Color = std::array<std::uint8_t, 3>;
constexpr Color kSupport{140, 140, 140};
constexpr Color kNoSegment{90, 90, 90};
constexpr Color kEdge{30, 30, 30};

/// Neighbouring numbers have hues far from each other.
Color segment_color(int segment) {
  const double hue = 6 * std::fmod(0.61803398875 * segment, 1.0);
  const auto channel = [hue](double offset) {
    const double k = std::fmod(offset + hue, 6.0);
    return static_cast<std::uint8_t>(255 * (0.95 - 0.75 * std::clamp(std::min(k, 4 - k), 0.0, 1.0)));
  };
  return {channel(5), channel(3), channel(1)};
}

Color color_of(const SegmentedPoint& point) {
  if (point.is_edge) return kEdge;
  if (point.is_support) return kSupport;
  return point.segment < 0 ? kNoSegment : segment_color(point.segment);
}

std::vector<float> floats(const double* values, std::size_t n) {
  return {values, values + n};
}

drake::lcmt_viewer_geometry_data geometry(const std::string& name, TriangleMesh mesh,
                                          const std::array<float, 4>& color) {
  if (mesh.triangles.empty()) {
    mesh.vertices.assign(3, Eigen::Vector3f::Zero());
    mesh.triangles.push_back({0, 1, 2});
  }
  drake::lcmt_viewer_geometry_data data{};
  data.type = kMesh;
  data.quaternion[0] = 1;
  std::copy(color.begin(), color.end(), data.color);
  data.string_data = name;
  data.float_data = {static_cast<float>(mesh.vertices.size()), static_cast<float>(mesh.triangles.size())};
  for (const Eigen::Vector3f& v : mesh.vertices)
    data.float_data.insert(data.float_data.end(), {v.x(), v.y(), v.z()});
  for (const auto& triangle : mesh.triangles)
    for (const int corner : triangle) data.float_data.push_back(static_cast<float>(corner));
  data.num_float_data = static_cast<std::int32_t>(data.float_data.size());
  return data;
}

drake::lcmt_point_cloud_field field(const char* name, int offset, std::int8_t type) {
  drake::lcmt_point_cloud_field result;
  result.name = name;
  result.byte_offset = offset;
  result.datatype = type;
  result.count = 1;
  return result;
}

}  // namespace

drake::lcmt_viewer_draw handle_frames(const handle_list_t& list, std::size_t max_handles) {
  drake::lcmt_viewer_draw draw{};
  draw.timestamp = list.utime;
  const std::size_t n = std::min(max_handles, list.handles.size());
  draw.num_links = static_cast<std::int32_t>(n);
  for (std::size_t i = 0; i < n; ++i) {
    const handle_t& handle = list.handles[i];
    draw.link_name.push_back("handle_" + std::to_string(i));
    draw.robot_num.push_back(0);
    draw.position.push_back(floats(handle.position, 3));
    draw.quaternion.push_back(floats(handle.orientation, 4));
  }
  return draw;
}

drake::lcmt_viewer_link_data handle_grippers(const handle_list_t& list, std::size_t max_handles) {
  TriangleMesh best, others;
  const std::size_t n = std::min(max_handles, list.handles.size());
  for (std::size_t i = 0; i < n; ++i) add_gripper(i == 0 ? best : others, list.handles[i], list.gripper);
  drake::lcmt_viewer_link_data link;
  link.name = "graspd";
  link.robot_num = 0;
  link.geom = {geometry("best", std::move(best), {0.1f, 0.8f, 0.2f, 1}),
               geometry("others", std::move(others), {0.2f, 0.5f, 0.9f, 0.5f})};
  link.num_geom = static_cast<std::int32_t>(link.geom.size());
  return link;
}

drake::lcmt_viewer_draw no_poses() {
  return {};
}

drake::lcmt_point_cloud coloured_cloud(const segmentation_t& segmentation) {
  drake::lcmt_point_cloud cloud{};
  cloud.utime = segmentation.utime;
  cloud.frame_name = segmentation.frame_name;
  cloud.width = segmentation.num_points;
  cloud.height = 1;
  cloud.fields = {field("x", 0, kFloat32), field("y", 4, kFloat32), field("z", 8, kFloat32),
                  field("rgb", 12, kUint32)};
  cloud.num_fields = static_cast<std::int32_t>(cloud.fields.size());
  cloud.flags = kStrictlyFinite;
  cloud.point_step = kPointBytes;
  cloud.row_step = kPointBytes * cloud.width;
  cloud.data_size = cloud.row_step;
  cloud.data.resize(static_cast<std::size_t>(cloud.data_size));
  for (std::size_t i = 0; i < static_cast<std::size_t>(cloud.width); ++i) {
    const SegmentedPoint point = segmented_point(segmentation, i);
    const Eigen::Vector3f position = point.position.cast<float>();
    const Color color = color_of(point);
    std::uint8_t* bytes = cloud.data.data() + i * kPointBytes;
    std::memcpy(bytes, position.data(), 12);
    std::memcpy(bytes + 12, color.data(), color.size());
  }
  return cloud;
}

}  // namespace graspd
