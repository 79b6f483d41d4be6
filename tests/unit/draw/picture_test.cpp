// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/draw/picture.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <stdexcept>
#include <tuple>

#include "client/draw/palette.hpp"
#include "service/transport/handle_list_codec.hpp"
#include "service/transport/segmentation_codec.hpp"

namespace graspd {
namespace {

/// A wall at 0.9 m, and before its middle a square of 8 x 8 cm, which is segment 0 and has one handle.
PictureFrame wall_with_square() {
  PictureFrame frame;
  frame.title = "wall";
  Surfaces surfaces;
  for (int i = -100; i < 100; ++i) {
    for (int j = -80; j < 80; ++j) {
      const float x = 0.003f * static_cast<float>(i), y = 0.003f * static_cast<float>(j);
      const bool on_square = std::abs(x) < 0.04f && std::abs(y) < 0.04f;
      frame.cloud.cloud.push_back({x, y, on_square ? 0.8f : 0.9f});
      surfaces.cloud.push_back({x, y, on_square ? 0.8f : 0.9f});
      surfaces.segments.of_point.push_back(on_square ? 0 : -1);
    }
  }
  surfaces.is_edge.assign(surfaces.cloud.size(), 0);
  surfaces.support.emplace();
  surfaces.support->plane = {{0, 0, -1}, 0.9f};
  for (const std::int32_t segment : surfaces.segments.of_point)
    surfaces.support->is_support.push_back(std::uint8_t{segment < 0});
  Detection detection;
  detection.segments.resize(1);
  Handle handle;
  handle.position = {0, 0, 0.8f};
  handle.width_m = 0.05f;
  handle.score = 0.9f;
  handle.segment = 0;
  detection.handles = {handle};
  HandleListHeader header;
  header.voxel_m = 0.003;
  const auto T = Eigen::Isometry3f::Identity();
  frame.list = make_handle_list(header, Gripper{}, detection, T);
  frame.segmentation = make_segmentation(header, detection, surfaces, T);
  return frame;
}

bool is_segment(Color c) {
  const Color s = segment_color(0);
  return std::abs(c.r - s.r) + std::abs(c.g - s.g) + std::abs(c.b - s.b) < 60;
}

int count_segment(const Image& image) {
  int n = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) n += is_segment(image.at(x, y)) ? 1 : 0;
  return n;
}

std::size_t num_different(const Image& a, const Image& b) {
  std::size_t n = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) n += a.at(x, y) == b.at(x, y) ? 0 : 1;
  return n;
}

PictureOptions options(PictureView view) {
  PictureOptions result;
  result.view = view;
  result.width = 320;
  result.height = 240;
  return result;
}

TEST(Picture, TheGripperStandsOverTheSquare) {
  PictureFrame frame = wall_with_square();
  const auto camera = options(PictureView::kCamera);
  const Image with = draw_picture(frame, camera);
  // The hand comes from the camera: its palm, in the colour of its score, hides the middle of the square.
  const Color middle = with.at(160, 120);
  const Color score = score_color(0.9);
  EXPECT_LT(std::abs(middle.r - score.r) + std::abs(middle.g - score.g) + std::abs(middle.b - score.b), 200);
  EXPECT_GT(middle.r, middle.b + 50) << "yellow";
  frame.list.handles.clear();
  frame.list.num_handles = 0;
  auto all = camera;
  all.whole_cloud = true;
  const Image without = draw_picture(frame, all);
  EXPECT_TRUE(is_segment(without.at(160, 120)));
}

TEST(Picture, SegmentsTakeTheirShareOfThePicture) {
  PictureFrame frame = wall_with_square();
  frame.list.handles.clear();
  frame.list.num_handles = 0;
  auto all = options(PictureView::kCamera);
  all.whole_cloud = true;
  // 8 cm at 0.8 m is 9 cm on the wall of 60 x 48 cm, which fills the picture's height but for two margins.
  const double pixels_per_m = 240 * 0.88 / 0.48;
  const double side = 0.09 * pixels_per_m;
  EXPECT_NEAR(count_segment(draw_picture(frame, all)), side * side, 0.2 * side * side);
  frame.segmentation = segmentation_t{};
  EXPECT_EQ(count_segment(draw_picture(frame, all)), 0);
}

TEST(Picture, TheSameFrameGivesTheSamePicture) {
  const PictureFrame frame = wall_with_square();
  std::set<std::string> pictures;
  for (const auto view : {PictureView::kCamera, PictureView::kTop, PictureView::kFront}) {
    const std::string png = encode_png(draw_picture(frame, options(view)));
    EXPECT_EQ(png, encode_png(draw_picture(frame, options(view))));
    pictures.insert(png);
  }
  EXPECT_EQ(pictures.size(), 3u);
}

TEST(Picture, IsTheSameFromWhereverTheFrameIsNamed) {
  PictureFrame frame = wall_with_square();
  const Image plain = draw_picture(frame, options(PictureView::kCamera));
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.translate(Eigen::Vector3f(1, -2, 0.5f))
      .rotate(Eigen::AngleAxisf(2, Eigen::Vector3f(1, 2, 3).normalized()));
  Handle handle;
  handle.position = {0, 0, 0.8f};
  handle.width_m = 0.05f;
  handle.score = 0.9f;
  Detection detection;
  detection.handles = {handle};
  frame.list = make_handle_list({}, Gripper{}, detection, T);
  Surfaces surfaces;  // the same points, seen from the segmentation
  for (std::size_t i = 0; i < static_cast<std::size_t>(frame.segmentation.num_points); ++i) {
    const SegmentedPoint point = segmented_point(frame.segmentation, i);
    surfaces.cloud.push_back(point.position.cast<float>());
    surfaces.is_edge.push_back(0);
    surfaces.segments.of_point.push_back(point.segment);
  }
  surfaces.support.emplace();
  surfaces.support->plane = {{0, 0, -1}, 0.9f};
  surfaces.support->is_support.assign(surfaces.cloud.size(), 0);
  detection.segments.resize(1);
  HandleListHeader header;
  header.voxel_m = 0.003;
  frame.segmentation = make_segmentation(header, detection, surfaces, T);
  frame.T_frame_cloud = T;
  const Image moved = draw_picture(frame, options(PictureView::kCamera));
  EXPECT_LT(num_different(plain, moved), 320u * 240u / 10);
}

TEST(Picture, ColorsComeFromTheCloudOrFromTheDepth) {
  PictureFrame frame = wall_with_square();
  frame.list.handles.clear();
  frame.list.num_handles = 0;
  frame.cloud.rgb.assign(frame.cloud.cloud.size(), 0x102030);
  auto rgb = options(PictureView::kCamera);
  rgb.color = PictureColor::kRgb;
  EXPECT_EQ(draw_picture(frame, rgb).at(160, 100), (Color{0x10, 0x20, 0x30}));
  auto depth = rgb;
  depth.color = PictureColor::kDepth;
  const Image by_depth = draw_picture(frame, depth);
  frame.cloud.rgb.clear();
  EXPECT_EQ(num_different(draw_picture(frame, rgb), by_depth), 0u) << "no colours: by depth";
}

TEST(Picture, OnlyAsManyHandlesAsAskedFor) {
  const PictureFrame frame = wall_with_square();
  auto none = options(PictureView::kCamera);
  none.max_handles = 0;
  EXPECT_GT(num_different(draw_picture(frame, none), draw_picture(frame, options(PictureView::kCamera))),
            1000u);
}

TEST(Picture, NothingAndNonsenseCanBeDrawn) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr double kNanDouble = std::numeric_limits<double>::quiet_NaN();
  PictureFrame frame;
  for (const auto view : {PictureView::kCamera, PictureView::kTop, PictureView::kFront}) {
    EXPECT_EQ(draw_picture(frame, options(view)).width(), 320);
    PictureFrame bad;
    bad.cloud.cloud.push_back({kNan, 0, 1});
    bad.cloud.cloud.push_back({0, 0, 1e30f});
    bad.cloud.cloud.push_back({0, 0, 0});
    bad.list = wall_with_square().list;
    bad.list.handles[0].position[0] = kNanDouble;
    bad.list.handles[0].score = kNanDouble;
    bad.list.handles.push_back(bad.list.handles[0]);
    bad.list.handles[1].position[0] = 1e300;
    bad.list.handles[1].width = -1e300;
    EXPECT_EQ(draw_picture(bad, options(view)).height(), 240);
  }
  for (const int side : {-1, 0, 63, 8193}) {
    auto size = options(PictureView::kTop);
    size.width = side;
    EXPECT_THROW((void)draw_picture(frame, size), std::invalid_argument);
  }
}

}  // namespace
}  // namespace graspd
