// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The first half of the method: from points to segments and objects (paper, section 4).
#pragma once
#include <cstdint>
#include <functional>
#include <memory_resource>
#include <optional>
#include <string_view>
#include <vector>

#include "service/pipeline/box_query.hpp"
#include "service/pipeline/detect_config.hpp"

namespace graspd {

/// Called with a stage's name when the stage is done; the caller keeps the time.
using StageObserver = std::function<void(std::string_view stage)>;

/// Voxels spread more thinly, for first looks at many candidates.
struct SparseVoxels {
  PointCloud cloud;
  RawVector<std::uint32_t> voxel;  ///< that each of them is
  float spacing_m = 0;
  BoxQuery query;
};

/// Everything that is known of the voxels' surfaces; vectors have one element a voxel.
struct Surfaces {
  PointCloud cloud;
  SparseVoxels sparse;                      ///< but for the support's
  RawVector<std::uint32_t> voxel_of_point;  ///< for each point before downsampling
  BoxQuery points;                          ///< those before downsampling, but for the support's
  Normals normals;
  std::pmr::vector<std::uint8_t> is_edge;
  std::optional<Support> support;
  Segments segments;
  Objects objects;
  Objects wholes;  ///< the coarser guess: each is one object or several
};

/// All points must be finite, and there must be at least one. pixels: of the cloud's points, where it is part
/// of an image.
[[nodiscard]] Surfaces find_surfaces(const PointCloud& cloud, const DetectConfig& config,
                                     const StageObserver& done, const ImagePixels& pixels = {});

}  // namespace graspd
