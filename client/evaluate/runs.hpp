// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Runs of detection that are measured side by side: other settings, other clouds, other grippers.
#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "service/pipeline/detect_config.hpp"
#include "service/pipeline/gripper.hpp"
#include "service/pipeline/point_cloud.hpp"

namespace graspd {

/// What is done to a cloud before detection; it is judged on the whole cloud all the same.
struct CloudChange {
  bool half = false;         ///< every second row and column; of unorganized clouds every fourth point
  bool unorganized = false;  ///< finite points alone, in no order
};

[[nodiscard]] PointCloud changed(const PointCloud& cloud, const CloudChange& change);

struct DetectionRun {
  std::string name;
  Gripper gripper;
  DetectConfig detect;
  CloudChange change;
};

/// Voxels of another size; neighbourhoods keep theirs within 2 to 8 voxels.
void set_voxel(DetectConfig& config, float leaf_m);

/// The paper to the letter: its thresholds, its bands alone, and of the checks d, the gaps g and the depth l.
[[nodiscard]] DetectConfig paper_settings(const DetectConfig& config);

/// thresholds: single ones beside the two; paper: the paper's settings and what each part of this method adds
/// to them; voxels, clouds, grippers: other voxels, other clouds, other apertures.
inline constexpr std::array<std::string_view, 5> kVariantGroups{"thresholds", "paper", "voxels", "clouds",
                                                                "grippers"};

/// The runs of a group, named; base itself is not among them.
[[nodiscard]] std::vector<DetectionRun> variants(const DetectionRun& base, std::string_view group);

}  // namespace graspd
