// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Pictures in memory, and as PNG.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace graspd {

struct Color {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Color&) const = default;
};

/// Between two colours; share 0: the first one.
[[nodiscard]] Color mixed(Color a, Color b, float share);

/// Row by row from the top left; no size below 0.
class Image {
 public:
  Image() = default;
  Image(int width, int height, Color background);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Inside the picture only.
  [[nodiscard]] Color& at(int x, int y) { return pixels_[index(x, y)]; }
  [[nodiscard]] Color at(int x, int y) const { return pixels_[index(x, y)]; }
  /// What is outside of the picture is left out.
  void fill(int x, int y, int width, int height, Color color);

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<Color> pixels_;
};

/// The bytes of a PNG file, 8 bits a channel. The same picture gives the same bytes with the same libpng and
/// zlib. Throws std::runtime_error when there is nothing to write or no memory.
[[nodiscard]] std::string encode_png(const Image& image);

}  // namespace graspd
