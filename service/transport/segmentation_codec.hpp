// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of a detection -> segmentation_t -> message, and back for clients.
#pragma once
#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "graspd/segmentation_t.hpp"
#include "service/pipeline/detect_handles.hpp"
#include "service/transport/handle_list_codec.hpp"

namespace graspd {

/// The points that the handles were looked for on, and what is said of their segments, in the target frame.
/// header: the handle list's; surfaces: the detection's, at least one point, of which the support's are
/// thinned out. Points of segments beyond the number that fits the wire belong to none there.
[[nodiscard]] segmentation_t make_segmentation(const HandleListHeader& header, const Detection& detection,
                                               const Surfaces& surfaces,
                                               const Eigen::Isometry3f& T_target_cloud);

/// The message, fingerprint first. Throw std::invalid_argument when a count is not the length of its array.
/// The second form reuses the buffer's memory.
[[nodiscard]] std::vector<std::byte> encode(const segmentation_t& segmentation);
void encode(const segmentation_t& segmentation, std::vector<std::byte>& buffer);

/// Nothing unless the message is a whole, valid segmentation_t whose points belong to segments that it has,
/// or to none. Trusts nothing in the bytes.
[[nodiscard]] std::optional<segmentation_t> decode_segmentation(std::span<const std::byte> message);

/// One point of a segmentation.
struct SegmentedPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], in the segmentation's frame
  int segment = -1;                                    ///< -1: none
  bool is_edge = false;
  bool is_support = false;
};

/// i below num_points of a segmentation that was made or decoded here.
[[nodiscard]] SegmentedPoint segmented_point(const segmentation_t& segmentation, std::size_t i);

}  // namespace graspd
