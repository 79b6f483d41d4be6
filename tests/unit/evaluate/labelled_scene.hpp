// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Labelled frames of analytic scenes, and handles on what stands in them.
#pragma once
#include "client/common/cloud_file.hpp"
#include "service/pipeline/handle.hpp"
#include "tests/support/scene_gallery.hpp"

namespace graspd {

/// Solid 0 is the support, label 1; solid k is object k + 1, label 10 (k + 1).
[[nodiscard]] LabelledCloud labelled(const AnalyticScene& scene);

/// From above, the jaws closing along x turned by yaw about the approach.
[[nodiscard]] Handle from_above(const Eigen::Vector3f& position, float width_m, float yaw_rad = 0);

/// The middle of the top of box_on_table(): it holds.
[[nodiscard]] Handle on_box();

}  // namespace graspd
