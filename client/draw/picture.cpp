// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/draw/picture.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "client/common/text.hpp"
#include "client/draw/canvas.hpp"
#include "client/draw/gripper_shape.hpp"
#include "client/draw/lettering.hpp"
#include "client/draw/palette.hpp"
#include "client/draw/projection.hpp"
#include "service/transport/segmentation_codec.hpp"

namespace graspd {
namespace {

constexpr int kSmallestSide = 64, kLargestSide = 8192;
constexpr float kStrays = 0.01f;  // share of a cloud's points that may lie beyond the picture, on each side
constexpr int kFiner = 2;         // drawn so much larger, for smooth borders

/// What is seen, in the frame of the handles.
struct Scene {
  std::vector<Eigen::Vector3f> points;
  std::vector<std::uint32_t> rgb;  // empty or one a point
  Eigen::Vector3f viewpoint;
  std::vector<Eigen::Vector3f> things;  // what is of interest: not the support
  Eigen::Vector3f up;
};

Eigen::Vector3f vector(const double (&values)[3]) {
  return Eigen::Vector3d(values).cast<float>();
}

bool has_plane(const segmentation_t& segmentation) {
  return vector({segmentation.support_plane[0], segmentation.support_plane[1], segmentation.support_plane[2]})
             .norm() > 0.5f;
}

/// Of the support where there is one, else of a camera that is held level.
Eigen::Vector3f up_of(const PictureFrame& frame) {
  const double* plane = frame.segmentation.support_plane;
  if (has_plane(frame.segmentation)) return Eigen::Vector3d(plane[0], plane[1], plane[2]).cast<float>();
  return frame.T_frame_cloud.linear() * -Eigen::Vector3f::UnitY();
}

Scene scene_of(const PictureFrame& frame) {
  const PointCloud& cloud = frame.cloud.cloud;
  Scene scene;
  const bool colored = frame.cloud.rgb.size() == cloud.size();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f point = cloud.point(i);
    if (!point.allFinite()) continue;
    scene.points.push_back(frame.T_frame_cloud * point);
    if (colored) scene.rgb.push_back(frame.cloud.rgb[i]);
  }
  scene.viewpoint = frame.T_frame_cloud * cloud.viewpoint;
  scene.up = up_of(frame);
  for (std::size_t i = 0; i < static_cast<std::size_t>(frame.segmentation.num_points); ++i) {
    const SegmentedPoint point = segmented_point(frame.segmentation, i);
    if (point.segment >= 0) scene.things.push_back(point.position.cast<float>());
  }
  for (const handle_t& handle : frame.list.handles)
    for (const Box& box : gripper_shape(frame.list.gripper, handle).boxes)
      scene.things.insert(scene.things.end(), box.begin(), box.end());
  return scene;
}

Eigen::Vector3f mean(const std::vector<Eigen::Vector3f>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& point : points) sum += point.cast<double>();
  return (sum / std::max<double>(1, static_cast<double>(points.size()))).cast<float>();
}

/// Drivers give clouds in the optical frame (z forward) or in another one; who looks along z sees the former
/// as the sensor did.
Eigen::Isometry3f as_the_sensor(const PictureFrame& frame, const Scene& scene) {
  const Eigen::Vector3f middle = mean(scene.points) - scene.viewpoint;
  const Eigen::Matrix3f axes = frame.T_frame_cloud.linear();
  const bool is_optical = middle.dot(axes.col(2)) > 0.7f * middle.norm();
  const Eigen::Vector3f forward = is_optical ? Eigen::Vector3f(axes.col(2)) : middle;
  return looking(scene.viewpoint, forward, is_optical ? Eigen::Vector3f(-axes.col(1)) : scene.up);
}

Projection projection_of(const PictureFrame& frame, const Scene& scene, const PictureOptions& options) {
  using Kind = Projection::Kind;
  const Eigen::Isometry3f T_sensor_frame = as_the_sensor(frame, scene);
  const Eigen::Vector3f ahead = T_sensor_frame.linear().row(2);
  const Eigen::Vector3f level = ahead - ahead.dot(scene.up) * scene.up;
  Projection projection(Kind::kCamera, T_sensor_frame);
  if (options.view == PictureView::kTop)
    projection = Projection(Kind::kParallel, looking(scene.viewpoint, -scene.up, ahead));
  if (options.view == PictureView::kFront) {
    // Of a sensor that looks straight down the front is the lower border of its picture.
    const Eigen::Vector3f into_picture = -T_sensor_frame.linear().row(1);
    const Eigen::Vector3f forward = level.norm() > 0.1f ? level : into_picture;
    projection = Projection(Kind::kParallel, looking(scene.viewpoint, forward, scene.up));
  }
  const bool all = options.whole_cloud || scene.things.empty();
  projection.fit(all ? scene.points : scene.things, all ? kStrays : 0, kFiner * options.width,
                 kFiner * options.height);
  return projection;
}

/// The angle between points next to each other, as seen by the sensor.
float spacing_rad(const PictureFrame& frame, const Scene& scene) {
  Projection sensor(Projection::Kind::kCamera, as_the_sensor(frame, scene));
  constexpr int kSide = 1000;
  sensor.fit(scene.points, kStrays, kSide, kSide);
  // The picture's longer side is filled; a sensor's other side is three quarters of it.
  const float extent = 0.9f * kSide / sensor.pixels_per_m(1);
  return extent * std::sqrt(0.75f / std::max(1.0f, static_cast<float>(scene.points.size())));
}

struct Range {
  float near_m = 0, far_m = 1;
};

Range depth_range(const Scene& scene, const Projection& projection, const PictureOptions& options) {
  std::vector<float> depths;
  for (const Eigen::Vector3f& point : scene.points) {
    const auto place = projection.project(point);
    const bool seen = place && place->u >= 0 && place->v >= 0 &&
                      place->u < static_cast<float>(kFiner * options.width) &&
                      place->v < static_cast<float>(kFiner * options.height);
    if (seen) depths.push_back(projection.depth_of(place->nearness));
  }
  if (depths.empty()) return {};
  const auto at = [&](double share) {
    const auto i =
        depths.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(depths.size() - 1));
    std::nth_element(depths.begin(), i, depths.end());
    return *i;
  };
  return {at(0.02), at(0.98)};
}

class Painter {
 public:
  Painter(const PictureFrame& frame, const PictureOptions& options)
      : frame_(frame),
        options_(options),
        scene_(scene_of(frame)),
        projection_(projection_of(frame, scene_, options)),
        color_(options.color == PictureColor::kRgb && scene_.rgb.empty() ? PictureColor::kDepth
                                                                         : options.color),
        range_(depth_range(scene_, projection_, options)),
        canvas_(kFiner * options.width, kFiner * options.height, kWhite) {}

  Image paint() {
    paint_points();
    if (color_ == PictureColor::kSegment) paint_segments();
    canvas_.shade_depth(projection_, color_ == PictureColor::kRgb ? 0.4f : 1.0f);
    const std::size_t n = std::min(options_.max_handles, frame_.list.handles.size());
    for (std::size_t i = n; i-- > 0;) paint_handle(frame_.list.handles[i], i == 0);
    Image image = canvas_.halved();
    write_words(image);
    return image;
  }

 private:
  void paint_points() {
    const float spacing = 1.3f * spacing_rad(frame_, scene_);
    for (std::size_t i = 0; i < scene_.points.size(); ++i) {
      const Eigen::Vector3f& point = scene_.points[i];
      const auto place = projection_.project(point);
      if (!place) continue;
      const float depth = projection_.depth_of(place->nearness);
      const float side_m = spacing * (point - scene_.viewpoint).norm();
      canvas_.splat(*place, side_m * projection_.pixels_per_m(depth), point_color(i, depth));
    }
  }

  [[nodiscard]] Color point_color(std::size_t i, float depth) const {
    if (color_ == PictureColor::kSegment) return kSupportColor;
    if (color_ == PictureColor::kDepth)
      return depth_color((depth - range_.near_m) / std::max(1e-6f, range_.far_m - range_.near_m));
    const std::uint32_t rgb = scene_.rgb[i];
    return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8),
            static_cast<std::uint8_t>(rgb)};
  }

  void paint_segments() {
    const auto voxel = static_cast<float>(frame_.segmentation.voxel_size);
    for (std::size_t i = 0; i < static_cast<std::size_t>(frame_.segmentation.num_points); ++i) {
      const SegmentedPoint point = segmented_point(frame_.segmentation, i);
      if (point.segment < 0 && !point.is_edge) continue;
      // Before the cloud's own points, which scatter about the voxel's.
      const auto place = projection_.project(point.position.cast<float>(), 2 * voxel);
      if (!place) continue;
      const float side = voxel * projection_.pixels_per_m(projection_.depth_of(place->nearness));
      const Color color = point.segment < 0 ? kSupportColor : segment_color(point.segment);
      canvas_.splat(*place, 1.2f * side, point.is_edge ? mixed(color, kEdgeColor, 0.6f) : color);
    }
  }

  void paint_handle(const handle_t& handle, bool is_best) {
    const Color color = score_color(handle.score);
    const float outline = static_cast<float>(kFiner) * (is_best ? 2.5f : 1.0f);
    for (const Box& box : gripper_shape(frame_.list.gripper, handle).boxes) {
      for (std::size_t side = 0; side < kBoxSides.size(); ++side) paint_side(box, side, color);
      for (const auto& [from, to] : kBoxEdges) {
        const auto a = projection_.project(box[from], 0.001f), b = projection_.project(box[to], 0.001f);
        if (a && b) canvas_.line(*a, *b, outline, kBlack);
      }
    }
  }

  void paint_side(const Box& box, std::size_t side, Color color) {
    std::array<Projected, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto place = projection_.project(box[kBoxSides[side][i]]);
      if (!place) return;
      corners[i] = *place;
    }
    // Sides in pairs are along x, y, z of the gripper: each pair a little darker, so that they can be told
    // apart.
    const Color shaded = mixed(color, kBlack, 0.15f * static_cast<float>(side / 2));
    canvas_.triangle({corners[0], corners[1], corners[2]}, shaded);
    canvas_.triangle({corners[0], corners[2], corners[3]}, shaded);
  }

  void write_words(Image& image) const {
    const auto& handles = frame_.list.handles;
    std::string line = printed("%zu handles", handles.size());
    if (handles.size() > options_.max_handles) line += printed(", the best %zu shown", options_.max_handles);
    if (!frame_.list.gripper.name.empty()) line += ", gripper " + frame_.list.gripper.name;
    write_label(image, 10, 10, frame_.title, kBlack);
    write_label(image, 10, 10 + kLetterHeight + 4, line, kBlack);
    if (!handles.empty()) label_best(image, handles.front());
    write_ruler(image);
    write_scores(image);
  }

  void label_best(Image& image, const handle_t& best) const {
    const auto place = projection_.project(gripper_shape(frame_.list.gripper, best).palm);
    if (!place) return;
    const std::string text = printed("best %.2f", best.score);
    const auto half = [](float value) { return static_cast<int>(std::clamp(value, -1e6f, 1e6f)) / kFiner; };
    write_label(image, std::clamp(half(place->u) - text_width(text) / 2, 4, image.width() - 4),
                std::clamp(half(place->v) - 2 * kLetterHeight, 4, image.height() - kLetterHeight), text,
                kBlack);
  }

  void write_ruler(Image& image) const {
    const bool is_camera = projection_.kind() == Projection::Kind::kCamera;
    float depth = 0.5f * (range_.near_m + range_.far_m);
    if (const auto place = projection_.project(mean(scene_.things.empty() ? scene_.points : scene_.things)))
      depth = projection_.depth_of(place->nearness);
    const double scale = double{projection_.pixels_per_m(std::max(depth, 0.01f))} / kFiner;
    const double length_m = ruler_length(scale, 0.25 * image.width());
    const int length = static_cast<int>(std::lround(length_m * scale)), y = image.height() - 16;
    std::string text = length_text(length_m);
    if (is_camera) text += printed(" at %.2f m", static_cast<double>(depth));
    write_label(image, 12, y - kLetterHeight - 6, text, kBlack);
    image.fill(10, y - 2, length + 4, 10, kWhite);
    image.fill(12, y, length, 6, kBlack);
    image.fill(12 + length / 4, y + 2, length / 4, 2, kWhite);
    image.fill(12 + 3 * (length / 4), y + 2, length / 4, 2, kWhite);
  }

  void write_scores(Image& image) const {
    if (color_ == PictureColor::kDepth)
      write_ramp(image, image.height() - 62, printed("depth %.2f", static_cast<double>(range_.near_m)),
                 printed("%.2f m", static_cast<double>(range_.far_m)), depth_color);
    write_ramp(image, image.height() - 30, "score 0", "1", score_color);
  }

  template <class Ramp>
  static void write_ramp(Image& image, int y, const std::string& low, const std::string& high, Ramp ramp) {
    constexpr int kLength = 120, kHeight = 14, kGap = 8;
    const int right = image.width() - 14 - text_width(high), left = right - kGap - kLength;
    write_label(image, right, y, high, kBlack);
    write_label(image, left - kGap - text_width(low), y, low, kBlack);
    for (int i = 0; i < kLength; ++i) image.fill(left + i, y, 1, kHeight, ramp(i / double{kLength - 1}));
  }

  const PictureFrame& frame_;
  const PictureOptions& options_;
  const Scene scene_;
  const Projection projection_;
  const PictureColor color_;
  const Range range_;
  Canvas canvas_;
};

}  // namespace

Image draw_picture(const PictureFrame& frame, const PictureOptions& options) {
  for (const int side : {options.width, options.height})
    if (side < kSmallestSide || side > kLargestSide)
      throw std::invalid_argument("a picture of " + std::to_string(side) + " pixels: expected 64 to 8192");
  return Painter(frame, options).paint();
}

}  // namespace graspd
