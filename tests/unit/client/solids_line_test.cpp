// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/simulate/solids_line.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "client/simulate/depth_camera.hpp"
#include "client/simulate/line_file.hpp"
#include "client/simulate/scene_builder.hpp"

namespace graspd {
namespace {

using nlohmann::json;

Eigen::Vector3d vector(const json& j) {
  return Eigen::Vector3d(j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>());
}

Eigen::Isometry3d pose(const json& j) {
  const json& q = j.at("orientation");
  EXPECT_GE(q.at(0).get<double>(), 0);
  const auto at = [&](int i) { return q.at(i).get<double>(); };
  Eigen::Isometry3d T(Eigen::Quaterniond(at(0), at(1), at(2), at(3)));
  T.translation() = vector(j.at("position"));
  return T;
}

Convex body(const json& j) {
  const auto type = j.at("type").get<std::string>();
  if (type == "box") return Box{vector(j.at("center")), vector(j.at("half"))};
  if (type == "ball") return Ball{vector(j.at("center")), j.at("radius")};
  if (type == "capsule") return Capsule{vector(j.at("a")), vector(j.at("b")), j.at("radius")};
  if (type == "cylinder") return Cylinder{j.at("radius"), j.at("z_min"), j.at("z_max")};
  EXPECT_EQ(type, "ball_slice");
  return BallSlice{j.at("radius"), j.at("z_min"), j.at("z_max")};
}

Solid solid(const json& j) {
  Solid read;
  read.kind = j.at("kind").get<std::string>();
  read.label = j.at("label");
  read.T_world_solid = pose(j.at("T_world_solid"));
  for (const json& part : j.at("parts")) read.parts.push_back(body(part));
  if (j.contains("cavity")) read.cavity = body(j.at("cavity"));
  return read;
}

/// Both have matter at the same places, the members of their parts to the last digit.
void expect_same(const Solid& a, const Solid& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.label, b.label);
  EXPECT_TRUE(a.T_world_solid.isApprox(b.T_world_solid, 1e-12));
  ASSERT_EQ(a.parts.size(), b.parts.size());
  ASSERT_EQ(a.cavity.has_value(), b.cavity.has_value());
  for (std::size_t i = 0; i < a.parts.size(); ++i) EXPECT_EQ(a.parts[i].index(), b.parts[i].index());
  for (const double x : {-0.03, 0.01, 0.06})
    for (const double y : {-0.05, 0.02})
      for (const double z : {-0.04, 0.0, 0.03, 0.08})
        EXPECT_EQ(signed_distance_in_solid(a, {x, y, z}), signed_distance_in_solid(b, {x, y, z})) << a.kind;
}

class SolidsOf : public testing::TestWithParam<SceneKind> {};

TEST_P(SolidsOf, AreReadBackAsTheyAre) {
  const Eigen::Isometry3d T_world_camera = look_at({0.1, -0.8, 0.6}, {0, 0, 0.03});
  std::set<std::size_t> types;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene = build_scene({GetParam(), {}}, seed);
    const std::string line = solids_line(7, scene, T_world_camera);
    EXPECT_EQ(line.find('\n'), line.size() - 1);
    const json read = json::parse(line);
    EXPECT_EQ(read.at("seq"), 7);
    EXPECT_TRUE(pose(read.at("T_world_camera")).isApprox(T_world_camera, 1e-12));
    ASSERT_EQ(read.at("solids").size(), scene.solids.size());
    for (std::size_t i = 0; i < scene.solids.size(); ++i) {
      expect_same(solid(read.at("solids").at(i)), scene.solids[i]);
      for (const Convex& part : scene.solids[i].parts) types.insert(part.index());
    }
  }
  EXPECT_GE(types.size(), GetParam() == SceneKind::kTable ? std::variant_size_v<Convex> : 3);
}

INSTANTIATE_TEST_SUITE_P(SolidsLine, SolidsOf,
                         testing::Values(SceneKind::kTable, SceneKind::kExtreme, SceneKind::kHousehold));

TEST(LineFile, SaysWhereItCannotBeWritten) {
  EXPECT_THROW(LineFile("/no/such/folder/solids.jsonl"), std::runtime_error);
}

}  // namespace
}  // namespace graspd
