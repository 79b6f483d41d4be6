// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Numbers of the Parquet format that writing and reading share.
#pragma once
#include <bit>
#include <cstdint>
#include <string_view>

namespace graspd::parquet {

static_assert(std::endian::native == std::endian::little, "Parquet is little-endian");

inline constexpr std::string_view kMagic = "PAR1";
inline constexpr std::int32_t kPlain = 0, kRle = 3;          // encodings
inline constexpr std::int32_t kUtf8 = 0;                     // converted type
inline constexpr std::int32_t kRequired = 0;                 // repetition
inline constexpr std::int32_t kDataPage = 0;                 // kind of a page
inline constexpr std::int32_t kUncompressed = 0, kZstd = 6;  // codecs

}  // namespace graspd::parquet
