// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Handle lists and segmentations -> the messages that Drake's viewer Meldis draws.
#pragma once
#include <cstddef>
#include <drake/lcmt_point_cloud.hpp>
#include <drake/lcmt_viewer_draw.hpp>
#include <drake/lcmt_viewer_link_data.hpp>
#include <vector>

#include "graspd/handle_list_t.hpp"
#include "graspd/segmentation_t.hpp"

namespace graspd {

/// A triad for each of the best handles: handle_0 is the best.
[[nodiscard]] drake::lcmt_viewer_draw handle_frames(const handle_list_t& list, std::size_t max_handles);

/// The grippers of the best handles as two meshes, "best" and "others", of one link. A mesh without grippers
/// is one triangle of no size: Meldis keeps what it is not told to replace.
[[nodiscard]] drake::lcmt_viewer_link_data handle_grippers(const handle_list_t& list,
                                                           std::size_t max_handles);

/// Poses of nothing. Meldis ends with an error where a mesh comes before the first poses.
[[nodiscard]] drake::lcmt_viewer_draw no_poses();

/// Every segment in a colour of its own, edge points dark, the support grey.
[[nodiscard]] drake::lcmt_point_cloud coloured_cloud(const segmentation_t& segmentation);

}  // namespace graspd
