// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/draw/canvas.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "client/draw/lettering.hpp"
#include "client/draw/palette.hpp"

namespace graspd {
namespace {

constexpr Color kRed{255, 0, 0}, kBlue{0, 0, 255};

int count(const Image& image, Color color) {
  int n = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) n += image.at(x, y) == color ? 1 : 0;
  return n;
}

TEST(Canvas, TheNearerOneHidesTheOtherInAnyOrder) {
  for (const bool near_first : {true, false}) {
    Canvas canvas(40, 40, kWhite);
    if (near_first) canvas.splat({20, 20, 2}, 8, kRed);
    canvas.splat({20, 20, 1}, 16, kBlue);
    if (!near_first) canvas.splat({20, 20, 2}, 8, kRed);
    const Image image = canvas.halved();
    EXPECT_EQ(count(image, kRed), 4 * 4);
    EXPECT_EQ(count(image, kBlue), 8 * 8 - 4 * 4);
  }
}

TEST(Canvas, TrianglesCoverTheirAreaOnceAndKeepTheirDepth) {
  Canvas canvas(200, 200, kWhite);
  const Projected a{20, 20, 1}, b{180, 20, 3}, c{180, 180, 3}, d{20, 180, 1};
  canvas.triangle({a, b, c}, kRed);
  canvas.triangle({a, d, c}, kRed);
  canvas.splat({60, 100, 2}, 20, kBlue);    // before the sloping square, which is at 1.5 there
  canvas.splat({140, 100, 2}, 20, kBlack);  // behind it: it is at 2.5 there
  const Image image = canvas.halved();
  EXPECT_EQ(count(image, kBlue), 100);
  EXPECT_EQ(count(image, kBlack), 0);
  EXPECT_NEAR(count(image, kRed), 80 * 80 - 100, 170) << "borders are mixed";
}

TEST(Canvas, WhateverIsOutsideOrNoNumberIsLeftOut) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kHuge = std::numeric_limits<float>::max();
  Canvas canvas(20, 20, kWhite);
  canvas.splat({-1000, 5, 1}, 4, kRed);
  canvas.splat({5, kHuge, 1}, 4, kRed);
  canvas.triangle({Projected{kNan, 0, 1}, {5, 5, 1}, {0, 5, 1}}, kRed);
  canvas.triangle({Projected{1, 1, 1}, {2, 2, 1}, {3, 3, 1}}, kRed);  // no area
  canvas.line({0, 0, 1}, {kHuge, 5, 1}, 2, kRed);
  EXPECT_EQ(count(canvas.halved(), kRed), 0);
  canvas.triangle({Projected{-kHuge, -1e4f, 1}, {1e4f, -1e4f, 1}, {0, 1e4f, 1}}, kRed);
  canvas.splat({10, 10, 2}, 1e9f, kBlue);
  EXPECT_EQ(count(canvas.halved(), kBlue), 100);
}

TEST(Image, PngHoldsEveryPixel) {
  Image image(67, 65, kWhite);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      image.at(x, y) = {static_cast<std::uint8_t>(3 * x), static_cast<std::uint8_t>(3 * y),
                        static_cast<std::uint8_t>(x * y)};
  const std::string bytes = encode_png(image);
  EXPECT_EQ(bytes, encode_png(image));
  png_image info{};
  info.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&info, bytes.data(), bytes.size()), 0);
  ASSERT_EQ(static_cast<int>(info.width), image.width());
  ASSERT_EQ(static_cast<int>(info.height), image.height());
  info.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(info));
  ASSERT_NE(png_image_finish_read(&info, nullptr, pixels.data(), 0, nullptr), 0);
  std::size_t i = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x, i += 3)
      ASSERT_EQ(image.at(x, y), (Color{pixels[i], pixels[i + 1], pixels[i + 2]})) << x << ' ' << y;
  }
  EXPECT_THROW((void)encode_png(Image()), std::runtime_error);
}

TEST(Lettering, WritesInsideOfItsWidthOnly) {
  const std::string text = "best 0.98";
  Image image(200, 60, kWhite);
  write_text(image, 20, 20, text, kRed);
  EXPECT_GT(count(image, kRed), 200);
  const Image before = image;
  image.fill(20, 20, text_width(text), kLetterHeight + 4, kWhite);
  EXPECT_EQ(count(image, kRed), 0) << "something is beside the text's own place";
  write_text(image, 190, 55, std::string(10'000, 'W') + "\xff\x01", kRed);  // runs out of the picture
  EXPECT_LT(count(image, kRed), 10 * 5 + 1);
}

TEST(Lettering, RulersAreRound) {
  EXPECT_NEAR(ruler_length(1000, 240), 0.2, 1e-9);
  EXPECT_NEAR(ruler_length(1000, 99), 0.05, 1e-9);
  EXPECT_NEAR(ruler_length(1, 240), 200, 1e-6);
  EXPECT_EQ(length_text(0.2), "20 cm");
  EXPECT_EQ(length_text(0.01), "1 cm");
  EXPECT_EQ(length_text(0.005), "5 mm");
  EXPECT_EQ(length_text(2), "2 m");
}

TEST(Palette, EndsAndBeyond) {
  EXPECT_EQ(score_color(0), score_color(-1));
  EXPECT_EQ(score_color(1), score_color(7));
  EXPECT_EQ(score_color(std::numeric_limits<double>::quiet_NaN()), score_color(0));
  // Lighter and lighter, so that the order is seen without colours, too.
  int last = -1;
  for (int i = 0; i <= 20; ++i) {
    const Color c = score_color(0.05 * i);
    const int lightness = 2 * c.r + 7 * c.g + c.b;
    EXPECT_GT(lightness, last);
    last = lightness;
  }
  EXPECT_EQ(segment_color(-5), segment_color(0));
}

}  // namespace
}  // namespace graspd
