// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/one_face.hpp"

#include <algorithm>
#include <array>
#include <functional>

namespace graspd {

float one_face(const SceneView& scene, const LocalPoints& local,
               const std::pmr::vector<std::uint32_t>& between, const Eigen::Vector3f& approach) {
  constexpr float kFacing = 0.85f;  // cosine
  constexpr float kGoodPart = 0.15f;
  constexpr std::size_t kMost = 8;  // segments; the jaws are not around more
  if (scene.segments == nullptr) return 1;
  std::array<std::int32_t, kMost> faces{};
  std::array<int, kMost> sizes{};
  std::size_t num_faces = 0;
  int all = 0;
  for (const std::uint32_t k : between) {
    const std::uint32_t voxel = scene.voxel[local.index[k]];
    if (-approach.dot(scene.normals.at(voxel)) < kFacing) continue;
    ++all;
    const std::int32_t segment = scene.segments->of_point[voxel];
    const auto i = static_cast<std::size_t>(std::find(faces.begin(), faces.begin() + num_faces, segment) -
                                            faces.begin());
    if (segment < 0 || i == kMost) continue;
    if (i == num_faces) faces[num_faces++] = segment;
    ++sizes[i];
  }
  std::nth_element(sizes.begin(), sizes.begin() + 1, sizes.end(), std::greater<>());
  return 1 - static_cast<float>(sizes[1]) / (kGoodPart * static_cast<float>(std::max(1, all)));
}

}  // namespace graspd
