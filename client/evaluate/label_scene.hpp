// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A labelled frame, prepared for judging many handles.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "client/common/cloud_file.hpp"
#include "service/pipeline/box_query.hpp"
#include "service/pipeline/depth_map.hpp"
#include "service/pipeline/support.hpp"

namespace graspd {

inline constexpr int kNoObject = -1;   ///< a point that belongs to nothing known
inline constexpr int kOnSupport = -2;  ///< a point of what the objects stand on

/// Labels follow the mOSD convention: 0 nothing, 1-9 support, 10 k ... 10 k + 9 object k.
[[nodiscard]] int object_of_label(std::uint32_t label);

/// The plane through the points, against a share of them that lie elsewhere; its normal is on the viewpoint's
/// side. Nothing for fewer than 100 points.
[[nodiscard]] std::optional<Plane> fit_plane(const std::vector<Eigen::Vector3f>& points,
                                             const Eigen::Vector3f& viewpoint);

/// Organized or not, seen from anywhere: points that are not finite are left out.
class LabelScene {
 public:
  /// Throws std::runtime_error when there are not as many labels as points.
  explicit LabelScene(const LabelledCloud& labelled);

  struct Object {
    int id = kNoObject;
    int points = 0;
  };

  [[nodiscard]] const PointCloud& cloud() const { return cloud_; }
  /// Object of each point, or one of the constants above.
  [[nodiscard]] int object_of(std::uint32_t point) const { return object_[point]; }
  [[nodiscard]] const std::vector<Object>& objects() const { return objects_; }  ///< ascending ids
  [[nodiscard]] const std::optional<Plane>& support() const { return support_; }
  [[nodiscard]] const BoxQuery& query() const { return query_; }
  [[nodiscard]] const DepthMap& depth_map() const { return depth_map_; }

 private:
  static PointCloud finite_points(const LabelledCloud& labelled, std::vector<std::uint32_t>& label);

  std::vector<std::uint32_t> label_;  // of each finite point
  PointCloud cloud_;
  std::vector<int> object_;
  std::vector<Object> objects_;
  std::optional<Plane> support_;
  BoxQuery query_;
  DepthMap depth_map_;
};

}  // namespace graspd
