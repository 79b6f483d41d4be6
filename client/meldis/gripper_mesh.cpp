// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/meldis/gripper_mesh.hpp"

#include "client/common/gripper_pose.hpp"

namespace graspd {
namespace {

// Of the corners of a Box, counter-clockwise from outside.
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

}  // namespace

void add_gripper(TriangleMesh& mesh, const handle_t& handle, const gripper_t& gripper) {
  const HandShape shape{handle.width, gripper.aperture, gripper.finger_width};
  for (const Box& box : gripper_boxes(gripper, shape, T_frame_gripper(handle))) {
    const int first = static_cast<int>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), box.begin(), box.end());
    for (const auto& t : kBoxTriangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

}  // namespace graspd
