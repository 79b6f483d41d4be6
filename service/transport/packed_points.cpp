// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/packed_points.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "service/transport/decoding.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

constexpr std::array<std::string_view, 3> kCoordinates{"x", "y", "z"};

/// One coordinate of every point.
struct Coordinate {
  std::size_t offset = 0;
  bool is_double = false;
};

std::string got_expected(std::int64_t got, const std::string& expected) {
  return " (got " + std::to_string(got) + ", expected " + expected + ")";
}

const PackedField* find_field(const PackedPoints& points, std::string_view name) {
  const auto found =
      std::find_if(points.fields.begin(), points.fields.end(), [&](const auto& f) { return f.name == name; });
  return found == points.fields.end() ? nullptr : &*found;
}

/// What is wrong with x, y or z; empty: nothing.
std::string field_problem(const PackedField& field, std::int64_t point_step) {
  if (field.datatype != kFloat32 && field.datatype != kFloat64)
    return "wrong datatype" + got_expected(field.datatype, "7, FLOAT32, or 8, FLOAT64");
  if (field.count != 1) return "not one value" + got_expected(field.count, "count 1");
  const auto size = static_cast<std::int64_t>(datatype_size(static_cast<std::int8_t>(field.datatype)));
  if (field.offset < 0 || field.offset + size > point_step)
    return "outside the point" +
           got_expected(field.offset, std::to_string(size) + " bytes within " + std::to_string(point_step));
  return {};
}

std::optional<Refusal> check_coordinates(std::string_view type, const PackedPoints& points) {
  for (const std::string_view name : kCoordinates) {
    const auto place = [&] { return std::string(type) + ".fields '" + std::string(name) + "'"; };
    const PackedField* field = find_field(points, name);
    if (field == nullptr)
      return refuse(RefusalReason::kMissingField, place(), "missing (expected x, y and z)", points.header);
    if (const std::string problem = field_problem(*field, points.point_step); !problem.empty())
      return refuse(RefusalReason::kBadField, place(), problem, points.header);
    if (std::count_if(points.fields.begin(), points.fields.end(),
                      [&](const auto& f) { return f.name == name; }) > 1)
      return refuse(RefusalReason::kBadField, place(), "there twice (expected once)", points.header);
  }
  return std::nullopt;
}

/// Of a cloud with points. Each product fits: two factors are at most the number of bytes of the data.
std::optional<Refusal> check_steps(std::string_view type, const PackedPoints& p) {
  const auto size = static_cast<std::int64_t>(p.data.size());
  if (p.point_step <= 0 || p.point_step > size)
    return refuse(RefusalReason::kBadSize, std::string(type) + ".point_step",
                  "not the size of a point" + got_expected(p.point_step, "1 to " + std::to_string(size)),
                  p.header);
  const std::int64_t row = p.width * p.point_step;
  const bool one_row = p.height == 1;
  if (!one_row && (p.row_step < row || p.row_step > size))
    return refuse(RefusalReason::kBadSize, std::string(type) + ".row_step",
                  "contradicts the other sizes" +
                      got_expected(p.row_step, std::to_string(row) + " to " + std::to_string(size)),
                  p.header);
  const std::int64_t least = one_row ? row : (p.height - 1) * p.row_step + row;
  const std::int64_t most = one_row ? std::max(row, p.row_step) : p.height * p.row_step;
  if (size >= least && size <= most) return std::nullopt;
  return refuse(RefusalReason::kBadSize, std::string(type) + ".data",
                "contradicts the other sizes" +
                    got_expected(size, std::to_string(p.height) + " rows of " + std::to_string(p.width) +
                                           " * " + std::to_string(p.point_step) + " bytes"),
                p.header);
}

Coordinate coordinate(const PackedPoints& points, std::string_view name) {
  const PackedField& field = *find_field(points, name);
  return {static_cast<std::size_t>(field.offset), field.datatype == kFloat64};
}

template <class Float>
float load(const std::byte* bytes, bool big_endian) {
  using Bits = std::conditional_t<sizeof(Float) == 4, std::uint32_t, std::uint64_t>;
  Bits bits = 0;
  std::memcpy(&bits, bytes, sizeof(bits));
  if (big_endian) {
    if constexpr (sizeof(Float) == 4)
      bits = __builtin_bswap32(bits);
    else
      bits = __builtin_bswap64(bits);
  }
  Float value = 0;
  std::memcpy(&value, &bits, sizeof(value));
  return static_cast<float>(value);
}

/// One coordinate of a row.
template <class Float>
void copy_row(const std::byte* from, std::size_t point_step, bool big_endian, std::span<float> to) {
  for (float& value : to) {
    value = load<Float>(from, big_endian);
    from += point_step;
  }
}

void copy_coordinate(const PackedPoints& p, const Coordinate& c, std::span<float> to) {
  const auto width = static_cast<std::size_t>(p.width);
  const auto point_step = static_cast<std::size_t>(p.point_step);
  const std::byte* row = p.data.data() + c.offset;
  for (std::size_t done = 0; done < to.size(); done += width) {
    const std::span<float> values = to.subspan(done, width);
    if (c.is_double)
      copy_row<double>(row, point_step, p.big_endian, values);
    else
      copy_row<float>(row, point_step, p.big_endian, values);
    // Beyond the last row there may be nothing to point to.
    if (done + width < to.size()) row += p.row_step;
  }
}

void blank_origin(PointCloud& cloud) {
  constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.x[i] == 0 && cloud.y[i] == 0 && cloud.z[i] == 0)
      cloud.x[i] = cloud.y[i] = cloud.z[i] = kMissing;
  }
}

}  // namespace

std::optional<Refusal> check_packed_points(std::string_view type, const PackedPoints& points,
                                           const DecodeLimits& limits) {
  const auto product = [&] { return std::to_string(points.width) + " * " + std::to_string(points.height); };
  if (points.width < 0 || points.height < 0)
    return refuse(RefusalReason::kBadSize, std::string(type) + ".width, height",
                  "negative (got " + product() + ", expected at least 0)", points.header);
  if (points.width == 0 || points.height == 0) {
    if (points.data.empty()) return std::nullopt;
    return refuse(RefusalReason::kBadSize, std::string(type) + ".data",
                  "contradicts the other sizes" +
                      got_expected(static_cast<std::int64_t>(points.data.size()), "none for " + product()),
                  points.header);
  }
  if (points.width > limits.max_points / points.height)
    return refuse(
        RefusalReason::kTooLarge, std::string(type) + ".width * height",
        "too many points (got " + product() + ", expected at most " + std::to_string(limits.max_points) + ")",
        points.header);
  auto refusal = check_steps(type, points);
  if (!refusal) refusal = check_coordinates(type, points);
  return refusal;
}

Frame unpack(PackedPoints&& points, const CloudInput& input) {
  Frame frame{points.header.utime, points.header.seq, std::move(points.header.frame_name), {}};
  PointCloud& cloud = frame.cloud;
  cloud.width = static_cast<int>(points.width);
  cloud.height = static_cast<int>(points.height);
  cloud.viewpoint = input.viewpoint_m;
  cloud.resize(static_cast<std::size_t>(points.width) * static_cast<std::size_t>(points.height));
  if (cloud.empty()) return frame;
  copy_coordinate(points, coordinate(points, "x"), cloud.x);
  copy_coordinate(points, coordinate(points, "y"), cloud.y);
  copy_coordinate(points, coordinate(points, "z"), cloud.z);
  blank_origin(cloud);
  return frame;
}

}  // namespace graspd
