// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/draw/lettering.hpp"

#include <stb/stb_easy_font.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "client/common/text.hpp"
#include "client/draw/palette.hpp"

namespace graspd {
namespace {

constexpr int kScale = 2;                  // of the font's pixels
constexpr std::size_t kLongest = 200;      // letters of a text
constexpr std::size_t kLetterBytes = 270;  // that the font says a letter may take

/// stb_easy_font takes a writable text and knows ASCII alone.
std::string printable(const std::string& text) {
  std::string result = text.substr(0, kLongest);
  for (char& c : result)
    if (c < ' ' || c > '~') c = '?';
  return result;
}

struct Corner {  // as stb_easy_font writes it
  float x, y, z;
  std::array<unsigned char, 4> color;
};

}  // namespace

int text_width(const std::string& text) {
  std::string letters = printable(text);
  return kScale * stb_easy_font_width(letters.data());
}

void write_text(Image& image, int x, int y, const std::string& text, Color color) {
  std::string letters = printable(text);
  std::vector<Corner> corners((letters.size() + 1) * kLetterBytes / sizeof(Corner));
  const int rectangles = stb_easy_font_print(0, 0, letters.data(), nullptr, corners.data(),
                                             static_cast<int>(corners.size() * sizeof(Corner)));
  for (int i = 0; i < rectangles; ++i) {
    const Corner& low = corners[4 * static_cast<std::size_t>(i)];
    const Corner& high = corners[4 * static_cast<std::size_t>(i) + 2];
    const auto pixels = [](float value) { return kScale * static_cast<int>(std::lround(value)); };
    image.fill(x + pixels(low.x), y + pixels(low.y), pixels(high.x - low.x), pixels(high.y - low.y), color);
  }
}

void write_label(Image& image, int x, int y, const std::string& text, Color color) {
  constexpr int kRoom = 3;
  const int left = std::max(0, x - kRoom), top = std::max(0, y - kRoom);
  const int right = std::min(image.width(), x + text_width(text) + kRoom);
  const int bottom = std::min(image.height(), y + kLetterHeight + kRoom - 2);
  for (int row = top; row < bottom; ++row)
    for (int column = left; column < right; ++column)
      image.at(column, row) = mixed(image.at(column, row), kWhite, 0.8f);
  write_text(image, x, y, text, color);
}

double ruler_length(double pixels_per_m, double most_pixels) {
  const double most_m = most_pixels / pixels_per_m;
  const double power = std::pow(10.0, std::floor(std::log10(most_m)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= most_m) return factor * power;
  return power;
}

std::string length_text(double length_m) {
  if (length_m < 0.00999) return printed("%g mm", 1000 * length_m);
  if (length_m < 0.999) return printed("%g cm", 100 * length_m);
  return printed("%g m", length_m);
}

}  // namespace graspd
