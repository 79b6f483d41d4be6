// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What the sensor saw: a depth image, to tell free space from hidden space. It is the cloud's own image where
// the points are known to be one, else it is rendered from them.
#pragma once
#include <Eigen/Geometry>
#include <cstdint>

#include "service/pipeline/pinhole_fit.hpp"
#include "service/pipeline/point_cloud.hpp"
#include "service/pipeline/point_kernels.hpp"

namespace graspd {

class DepthMap {
 public:
  /// All points must be finite. pixels: of the cloud's points, where it is part of an image.
  explicit DepthMap(const PointCloud& cloud, const ImagePixels& pixels = {});
  DepthMap(const DepthMap&) = delete;
  DepthMap& operator=(const DepthMap&) = delete;

  static constexpr std::int32_t kFree = -1, kOutOfView = -2;
  /// What is nearer to the sensor by this much hides a place from it [m]; less is the surface there itself.
  static constexpr float kHideMargin = 0.008f;

  /// The point of the cloud that hides p from the sensor, or kFree when nothing nearer than margin_m before
  /// it does. kOutOfView beyond the borders of the cloud's own image; of a rendered one they are not known,
  /// and nothing hides what is beyond them.
  [[nodiscard]] std::int32_t hider(const Eigen::Vector3f& p, float margin_m) const;

  /// The same for several places at once.
  void find_hiders(const Probes& places, float margin_m, std::int32_t (&hiders)[kProbes]) const;

  /// Area of the surface across the line of sight that one pixel covers at p [m2].
  [[nodiscard]] float ray_area(const Eigen::Vector3f& p) const;

 private:
  void take_image(const PointCloud& cloud, const ImagePixels& pixels, const PinholeModel& camera);
  /// Takes point i and those after it that lie in the next pixels, from the pixel on; returns how many.
  std::uint32_t take_pixels(const PointCloud& cloud, const ImagePixels& pixels, std::size_t i,
                            std::uint32_t at);
  void render(const PointCloud& cloud);
  void splat(const PointCloud& cloud);
  /// Those of fewer pixels.
  void close_gaps(std::size_t max_gap);
  /// Pixels [from, to) of a row, where nothing is seen, between two where something is.
  void close_gap(std::size_t from, std::size_t to);
  void fill(std::size_t from, std::size_t to, float depth, std::int32_t point);
  void set_size(int width, int height);

  RawVector<float> depth_;         // 0: nothing seen
  RawVector<std::int32_t> point_;  // that the depth is of
  ViewImage view_;                 // of both
  float point_area_ = 1;           // that a point stands for at depth 1
};

}  // namespace graspd
