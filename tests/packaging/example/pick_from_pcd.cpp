// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Finds handles in a PCD file with graspd's library, and prints the pose of each as a 4x4 matrix in one line.
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>
#include <graspd/pipeline/detect_handles.hpp>
#include <graspd/pipeline/pcl_adapter.hpp>

#include <cstdio>

int main(int argc, char** argv) {
  pcl::PointCloud<pcl::PointXYZ> cloud;
  if (argc != 2 || pcl::io::loadPCDFile(argv[1], cloud) != 0) {
    std::fprintf(stderr, "usage: pick_from_pcd FILE.pcd\n");
    return 2;
  }
  const graspd::Gripper gripper;  // lengths in metres; the defaults are those of an 80 mm gripper
  const graspd::Detection found =
      graspd::detect_handles(graspd::from_pcl(cloud), gripper, graspd::DetectConfig());
  for (const graspd::Handle& handle : found.handles) {
    Eigen::Isometry3f T_cloud_gripper = Eigen::Isometry3f::Identity();
    T_cloud_gripper.linear() = handle.rotation;
    T_cloud_gripper.translation() = handle.position;
    for (int i = 0; i < 16; ++i)
      std::printf("%.9g ", static_cast<double>(T_cloud_gripper.matrix()(i / 4, i % 4)));
    std::printf("%.9g\n", static_cast<double>(handle.score));
  }
  return found.handles.empty() ? 1 : 0;
}
