// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/truth_line.hpp"

#include <map>
#include <vector>

#include "client/common/json_writer.hpp"

namespace graspd {
namespace {

struct SeenObject {
  std::int64_t pixels = 0;
  std::vector<Eigen::Vector3f> points;
};

std::map<std::uint32_t, SeenObject> seen_objects(const DepthFrame& frame) {
  constexpr int kStep = 4;
  const PointCloud cloud = to_cloud(frame).cloud;
  std::map<std::uint32_t, SeenObject> objects;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (frame.label[i] < object_label(kFirstObject) || !(frame.depth_m[i] > 0)) continue;
    SeenObject& object = objects[frame.label[i]];
    ++object.pixels;
    const int u = static_cast<int>(i) % frame.camera.width, v = static_cast<int>(i) / frame.camera.width;
    if (u % kStep == 0 && v % kStep == 0) object.points.push_back(cloud.point(i));
  }
  return objects;
}

}  // namespace

std::string truth_line(std::int64_t seq, const DepthFrame& frame) {
  JsonWriter json;
  json.begin_object().member("seq", seq).key("objects").begin_array();
  for (const auto& [label, object] : seen_objects(frame)) {
    json.begin_object().member("label", label).member("pixels", object.pixels).key("points").begin_array();
    for (const Eigen::Vector3f& p : object.points)
      json.begin_array().value_float(p.x()).value_float(p.y()).value_float(p.z()).end_array();
    json.end_array().end_object();
  }
  json.end_array().end_object();
  return json.str() + '\n';
}

}  // namespace graspd
