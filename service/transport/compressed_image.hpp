// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Images behind zlib or in PNG, by the libraries of these, into memory of a size that is known before.
#pragma once
#include <cstddef>
#include <span>
#include <string>

namespace graspd {

/// Most bytes that so many compressed ones can stand for: more cannot be meant.
[[nodiscard]] std::size_t most_inflated(std::size_t compressed_bytes);

/// Fills `out` exactly; returns what is wrong, or nothing.
[[nodiscard]] std::string inflate(std::span<const std::byte> zlib, std::span<std::byte> out);

/// A PNG of one channel of 16 bits and this size, as little-endian numbers row by row; returns what is wrong,
/// or nothing.
[[nodiscard]] std::string read_png16(std::span<const std::byte> png, std::size_t width, std::size_t height,
                                     std::span<std::byte> out);

}  // namespace graspd
