// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/meldis/gripper_mesh.hpp"

#include <Eigen/Geometry>

namespace graspd {
namespace {

// Corner i has the upper limit in x, y, z where bit 0, 1, 2 of i is set.
constexpr std::array<std::array<int, 3>, 12> kBoxTriangles{{{0, 2, 3},
                                                            {0, 3, 1},
                                                            {4, 5, 7},
                                                            {4, 7, 6},
                                                            {0, 1, 5},
                                                            {0, 5, 4},
                                                            {2, 6, 7},
                                                            {2, 7, 3},
                                                            {0, 4, 6},
                                                            {0, 6, 2},
                                                            {1, 3, 7},
                                                            {1, 7, 5}}};

/// A box along the axes of the gripper.
void add_box(TriangleMesh& mesh, const Eigen::Isometry3d& T_frame_gripper, const Eigen::Vector3d& min,
             const Eigen::Vector3d& max) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d p((corner & 1) != 0 ? max.x() : min.x(), (corner & 2) != 0 ? max.y() : min.y(),
                            (corner & 4) != 0 ? max.z() : min.z());
    mesh.vertices.push_back((T_frame_gripper * p).cast<float>());
  }
  for (const auto& t : kBoxTriangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

}  // namespace

void add_gripper(TriangleMesh& mesh, const handle_t& handle, const gripper_t& gripper) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(handle.orientation[0], handle.orientation[1], handle.orientation[2],
                                  handle.orientation[3])
                   .normalized()
                   .toRotationMatrix();
  T.translation() = Eigen::Map<const Eigen::Vector3d>(handle.position);
  const double half = handle.width / 2, w = gripper.finger_width, e = gripper.finger_thickness / 2;
  const double tip = gripper.grasp_depth, root = tip - gripper.finger_length;
  const double palm = gripper.aperture / 2 + w;
  add_box(mesh, T, {-e, -half - w, root}, {e, -half, tip});
  add_box(mesh, T, {-e, half, root}, {e, half + w, tip});
  add_box(mesh, T, {-e, -palm, root - w}, {e, palm, root});
}

}  // namespace graspd
