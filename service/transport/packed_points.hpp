// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Points as others pack them: any fields at any offsets, either byte order, padding after points and rows.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "service/transport/cloud_input.hpp"
#include "service/transport/frame.hpp"
#include "service/transport/refusal.hpp"

namespace graspd {

/// Datatypes as in wire_layout.hpp, which are those of ROS.
struct PackedField {
  std::string_view name;
  std::int32_t offset = 0;
  std::int32_t datatype = 0;
  std::int32_t count = 0;
};

/// The members of a message as they came, unchecked; views into its bytes.
struct PackedPoints {
  FrameHeader header;
  std::int64_t width = 0;
  std::int64_t height = 0;
  std::pmr::vector<PackedField> fields;
  bool big_endian = false;
  std::int64_t point_step = 0;  ///< [bytes]
  std::int64_t row_step = 0;    ///< [bytes]; of a single row it says nothing
  std::span<const std::byte> data;
};

/// The sizes hold together and with the data, and x, y and z are FLOAT32 or FLOAT64 within each point. Fields
/// beside them may be anything, since nobody reads them.
[[nodiscard]] std::optional<Refusal> check_packed_points(std::string_view type, const PackedPoints& points,
                                                         const DecodeLimits& limits);

/// Points that have passed the check. A point at exactly (0, 0, 0) stands for none in these types: NaN.
[[nodiscard]] Frame unpack(PackedPoints&& points, const CloudInput& input);

}  // namespace graspd
