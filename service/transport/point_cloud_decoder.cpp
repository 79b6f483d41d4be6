// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/point_cloud_decoder.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory_resource>
#include <vector>

#include "service/transport/decoding.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

static_assert(std::endian::native == std::endian::little, "packed points are little-endian");

constexpr std::string_view kType = "point_cloud_t";
constexpr std::array<std::string_view, 3> kCoordinates{"x", "y", "z"};
constexpr std::size_t kMinFieldBytes = 14;  // a field with an empty name
constexpr double kMaxViewpoint_m = 1e6;     // beyond it a float no longer tells centimetres apart

struct Field {
  std::string_view name;
  std::int32_t offset = 0;
  std::int8_t datatype = 0;
  std::int32_t count = 0;
};

/// The members before the data, as they came.
struct Members {
  FrameHeader header;
  std::array<double, 3> viewpoint{};
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::pmr::vector<Field> fields;
  std::int32_t point_step = 0;
  std::int32_t data_size = 0;
};

/// Bytes from the start of a point.
using Offsets = std::array<std::size_t, 3>;

Members read_members(ByteReader& reader, const DecodeLimits& limits) {
  Members m;
  m.header = read_header(reader, limits);
  reader.float64s("viewpoint", m.viewpoint);
  m.width = reader.int32("width");
  m.height = reader.int32("height");
  m.fields.resize(static_cast<std::size_t>(reader.count("num_fields", limits.max_fields, kMinFieldBytes)));
  for (Field& field : m.fields) {
    field.name = reader.string("fields.name", limits.max_name_length);
    field.offset = reader.int32("fields.offset");
    field.datatype = reader.int8("fields.datatype");
    field.count = reader.int32("fields.count");
  }
  m.point_step = reader.int32("point_step");
  m.data_size = reader.int32("data_size");
  return m;
}

/// What is wrong with a field by itself; empty: nothing.
std::string field_problem(const Field& field, std::int32_t point_step) {
  const std::size_t size = datatype_size(field.datatype);
  if (size == 0) return "unknown datatype (got " + std::to_string(field.datatype) + ", expected 1 to 8)";
  if (field.count != 1) return "not one value (got count " + std::to_string(field.count) + ", expected 1)";
  if (field.offset < 0 || std::int64_t{field.offset} + static_cast<std::int64_t>(size) > point_step) {
    return "outside the point (got offset " + std::to_string(field.offset) + " of " + std::to_string(size) +
           " bytes, expected within " + std::to_string(point_step) + ")";
  }
  return {};
}

std::optional<Refusal> check_fields(const Members& m) {
  for (std::size_t i = 0; i < m.fields.size(); ++i) {
    const Field& field = m.fields[i];
    std::string problem = field_problem(field, m.point_step);
    for (std::size_t j = 0; j < i && problem.empty(); ++j) {
      if (m.fields[j].name == field.name) problem = "there already (expected each name once)";
    }
    if (problem.empty()) continue;
    return refuse(RefusalReason::kBadField,
                  "point_cloud_t.fields[" + std::to_string(i) + "] '" + printable(field.name) + "'", problem,
                  m.header);
  }
  return std::nullopt;
}

std::optional<Refusal> find_coordinates(const Members& m, Offsets& offsets) {
  for (std::size_t axis = 0; axis < kCoordinates.size(); ++axis) {
    const auto place = [axis] { return "point_cloud_t.fields '" + std::string(kCoordinates[axis]) + "'"; };
    const Field* found = nullptr;
    for (const Field& field : m.fields) {
      if (field.name == kCoordinates[axis]) found = &field;
    }
    if (found == nullptr) {
      return refuse(RefusalReason::kMissingField, place(), "missing (expected x, y and z)", m.header);
    }
    if (found->datatype != kFloat32) {
      return refuse(RefusalReason::kBadField, place(),
                    "wrong datatype (got " + std::to_string(found->datatype) + ", expected 7, FLOAT32)",
                    m.header);
    }
    offsets[axis] = static_cast<std::size_t>(found->offset);
  }
  return std::nullopt;
}

std::optional<Refusal> check_viewpoint(const Members& m) {
  for (const double v : m.viewpoint) {
    if (std::abs(v) <= kMaxViewpoint_m) continue;  // false for NaN
    return refuse(RefusalReason::kBadCalibration, "point_cloud_t.viewpoint",
                  "not a place (got " + number(v) + ", expected finite metres up to 1e6)", m.header);
  }
  return std::nullopt;
}

std::optional<Refusal> check(const Members& m, std::size_t remaining, const DecodeLimits& limits,
                             Offsets& offsets) {
  if (m.point_step < 0) {
    return refuse(RefusalReason::kBadSize, "point_cloud_t.point_step",
                  "negative (got " + std::to_string(m.point_step) + ", expected at least 12)", m.header);
  }
  auto refusal =
      check_layout({kType, m.width, m.height, m.point_step, m.data_size, remaining}, limits, m.header);
  if (!refusal) refusal = check_viewpoint(m);
  const bool has_points = m.width > 0 && m.height > 0;  // without any, fields say nothing
  if (!refusal && has_points) refusal = check_fields(m);
  if (!refusal && has_points) refusal = find_coordinates(m, offsets);
  return refusal;
}

/// A message that passed every check: what is left is to copy.
struct Parsed {
  Members members;
  Offsets offsets{};
  std::span<const std::byte> data;
};

std::variant<Parsed, Refusal> parse(std::span<const std::byte> message, const DecodeLimits& limits) {
  ByteReader reader(message);
  reader.skip("fingerprint", kFingerprintBytes);
  Parsed parsed{read_members(reader, limits), {}, {}};
  if (!reader.ok()) return refuse(reader, kType, parsed.members.header);
  if (auto refusal = check(parsed.members, reader.remaining(), limits, parsed.offsets))
    return *std::move(refusal);
  parsed.data = reader.bytes("data", reader.remaining());
  return parsed;
}

void unpack(std::span<const std::byte> data, std::size_t point_step, const Offsets& offsets,
            PointCloud& cloud) {
  const std::size_t n = cloud.size();
  const std::byte* point = data.data();
  float* __restrict x = cloud.x.data();
  float* __restrict y = cloud.y.data();
  float* __restrict z = cloud.z.data();
  for (std::size_t i = 0; i < n; ++i, point += point_step) {
    std::memcpy(x + i, point + offsets[0], sizeof(float));
    std::memcpy(y + i, point + offsets[1], sizeof(float));
    std::memcpy(z + i, point + offsets[2], sizeof(float));
  }
}

}  // namespace

std::optional<Refusal> check_point_cloud(std::span<const std::byte> message, const DecodeLimits& limits) {
  std::variant<Parsed, Refusal> parsed = parse(message, limits);
  if (auto* refusal = std::get_if<Refusal>(&parsed)) return std::move(*refusal);
  return std::nullopt;
}

std::variant<Frame, Refusal> decode_point_cloud(std::span<const std::byte> message,
                                                const DecodeLimits& limits) {
  std::variant<Parsed, Refusal> parsed = parse(message, limits);
  if (auto* refusal = std::get_if<Refusal>(&parsed)) return std::move(*refusal);
  Parsed& p = std::get<Parsed>(parsed);
  Members& m = p.members;
  Frame frame{m.header.utime, m.header.seq, std::move(m.header.frame_name), {}};
  frame.cloud.width = m.width;
  frame.cloud.height = m.height;
  frame.cloud.viewpoint = Eigen::Vector3d(m.viewpoint.data()).cast<float>();
  frame.cloud.resize(static_cast<std::size_t>(m.width) * static_cast<std::size_t>(m.height));
  unpack(p.data, static_cast<std::size_t>(m.point_step), p.offsets, frame.cloud);
  return frame;
}

}  // namespace graspd
