// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/solids_line.hpp"

#include <variant>

#include "client/common/json_writer.hpp"

namespace graspd {
namespace {

void write_vector(JsonWriter& json, std::string_view name, const Eigen::Vector3d& v) {
  json.key(name).begin_array().value(v.x()).value(v.y()).value(v.z()).end_array();
}

void write_pose(JsonWriter& json, std::string_view name, const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(pose.linear()).normalized();
  const double sign = q.w() < 0 ? -1 : 1;
  json.key(name).begin_object();
  write_vector(json, "position", pose.translation());
  json.key("orientation").begin_array();
  for (const double c : {q.w(), q.x(), q.y(), q.z()}) json.value(sign * c);
  json.end_array().end_object();
}

struct BodyWriter {
  JsonWriter& json;

  void operator()(const Box& box) const {
    json.member("type", "box");
    write_vector(json, "center", box.center);
    write_vector(json, "half", box.half);
  }
  void operator()(const Cylinder& c) const {
    json.member("type", "cylinder").member("radius", c.radius);
    json.member("z_min", c.z_min).member("z_max", c.z_max);
  }
  void operator()(const Ball& ball) const {
    json.member("type", "ball");
    write_vector(json, "center", ball.center);
    json.member("radius", ball.radius);
  }
  void operator()(const BallSlice& slice) const {
    json.member("type", "ball_slice").member("radius", slice.radius);
    json.member("z_min", slice.z_min).member("z_max", slice.z_max);
  }
  void operator()(const Capsule& capsule) const {
    json.member("type", "capsule");
    write_vector(json, "a", capsule.a);
    write_vector(json, "b", capsule.b);
    json.member("radius", capsule.radius);
  }
};

void write_body(JsonWriter& json, const Convex& body) {
  json.begin_object();
  std::visit(BodyWriter{json}, body);
  json.end_object();
}

void write_solid(JsonWriter& json, const Solid& solid) {
  json.begin_object().member("kind", solid.kind).member("label", solid.label);
  write_pose(json, "T_world_solid", solid.T_world_solid);
  json.key("parts").begin_array();
  for (const Convex& part : solid.parts) write_body(json, part);
  json.end_array();
  if (solid.cavity) {
    json.key("cavity");
    write_body(json, *solid.cavity);
  }
  json.end_object();
}

}  // namespace

std::string solids_line(std::int64_t seq, const Scene& scene, const Eigen::Isometry3d& T_world_camera) {
  JsonWriter json;
  json.begin_object().member("seq", seq);
  write_pose(json, "T_world_camera", T_world_camera);
  json.key("solids").begin_array();
  for (const Solid& solid : scene.solids) write_solid(json, solid);
  json.end_array().end_object();
  return json.str() + '\n';
}

}  // namespace graspd
