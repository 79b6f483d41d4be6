// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A frame as a picture: its points, its segments, and the gripper at its handles.
#pragma once
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "client/common/cloud_file.hpp"
#include "client/draw/image.hpp"
#include "graspd/handle_list_t.hpp"
#include "graspd/segmentation_t.hpp"

namespace graspd {

enum class PictureView {
  kCamera,  ///< from where the sensor was
  kTop,     ///< down on the support, along parallel lines
  kFront,   ///< from the sensor's side, level with the support, along parallel lines
};
enum class PictureColor {
  kSegment,  ///< each segment in its own colour, edge points dark
  kRgb,      ///< as the sensor saw it
  kDepth,    ///< by the distance along the line of sight
};

struct PictureOptions {
  PictureView view = PictureView::kCamera;
  PictureColor color = PictureColor::kSegment;
  int width = 960;   ///< [pixels], 64 to 8192
  int height = 720;  ///< the same
  std::size_t max_handles = 30;
  bool whole_cloud = false;  ///< fits all points into the picture; else only what is not the support
};

/// What is drawn. rgb of the cloud may be empty; then kRgb becomes kDepth.
struct PictureFrame {
  std::string title;
  LabelledCloud cloud;
  Eigen::Isometry3f T_frame_cloud = Eigen::Isometry3f::Identity();  ///< to the frame of what follows
  handle_list_t list{};
  segmentation_t segmentation{};  ///< without points where there is none
};

/// Every finite point as a square as large as it stands for; handles as true-size grippers, opened as wide as
/// they have to be, by score from dark blue to yellow, the best one with a thick outline and its score.
/// Title, scale bar and legend. The same arguments give the same picture. Throws std::invalid_argument for a
/// size that cannot be.
[[nodiscard]] Image draw_picture(const PictureFrame& frame, const PictureOptions& options);

}  // namespace graspd
