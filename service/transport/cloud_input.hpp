// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What some types that clouds come in do not say, and a source's configuration does.
#pragma once
#include <Eigen/Core>
#include <optional>

#include "service/pipeline/config_fields.hpp"

namespace graspd {

/// A rectified pinhole camera; pixel (u, v) has its centre at (u, v).
struct CameraIntrinsics {
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("fx_px", self.fx_px, Range{0, 1e7}, "focal length along a row [pixels]; 0: not known");
    v("fy_px", self.fy_px, Range{0, 1e7}, "focal length along a column [pixels]; 0: not known");
    v("cx_px", self.cx_px, Range{-1e7, 1e7}, "principal point along a row [pixels]");
    v("cy_px", self.cy_px, Range{-1e7, 1e7}, "principal point along a column [pixels]");
  }

  [[nodiscard]] bool given() const { return fx_px > 0; }
  /// Both focal lengths or none, each a camera's.
  [[nodiscard]] std::optional<ConfigProblem> validate() const {
    constexpr double kMinFocalLength = 1e-3;  // below it pixels are no longer finite points
    if ((fx_px > 0) != (fy_px > 0))
      return ConfigProblem{fx_px > 0 ? "fy_px" : "fx_px", "one focal length is given: expected both"};
    if (given() && (fx_px < kMinFocalLength || fy_px < kMinFocalLength))
      return ConfigProblem{fx_px < kMinFocalLength ? "fx_px" : "fy_px", "too small: expected at least 0.001"};
    return std::nullopt;
  }
};

struct CloudInput {
  Eigen::Vector3f viewpoint_m = Eigen::Vector3f::Zero();
  CameraIntrinsics camera;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("viewpoint_m", self.viewpoint_m, Range{-1000, 1000},
      "origin of the sensor in the cloud's frame, for clouds that do not carry it [m]");
    v("camera", self.camera, "intrinsics, for depth images that do not carry them");
  }
};

}  // namespace graspd
