// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Words, bars and rulers in a picture.
#pragma once
#include <string>

#include "client/draw/image.hpp"

namespace graspd {

inline constexpr int kLetterHeight = 18;  ///< of a line of text [pixels]

/// Width of a text [pixels]. Only printable ASCII is written, other characters as '?'.
[[nodiscard]] int text_width(const std::string& text);

/// x, y: its top left corner. What is outside of the picture is left out.
void write_text(Image& image, int x, int y, const std::string& text, Color color);

/// The same on a bright ground, so that it can be read anywhere.
void write_label(Image& image, int x, int y, const std::string& text, Color color);

/// A round length in metres that is at most this many pixels long: 1, 2 or 5 times a power of ten.
[[nodiscard]] double ruler_length(double pixels_per_m, double most_pixels);

/// "10 cm", "2 m", "5 mm".
[[nodiscard]] std::string length_text(double length_m);

}  // namespace graspd
