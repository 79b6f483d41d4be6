// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/depth_image_decoder.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "service/transport/decoding.hpp"
#include "service/transport/unproject.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

static_assert(std::endian::native == std::endian::little, "depths are little-endian");

constexpr std::string_view kType = "depth_image_t";

/// The members before the data, as they came.
struct Members {
  FrameHeader header;
  double depth_scale = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::int32_t data_size = 0;
};

Members read_members(ByteReader& reader, const DecodeLimits& limits) {
  Members m;
  m.header = read_header(reader, limits);
  m.depth_scale = reader.float64("depth_scale");
  m.fx = reader.float64("fx");
  m.fy = reader.float64("fy");
  m.cx = reader.float64("cx");
  m.cy = reader.float64("cy");
  m.width = reader.int32("width");
  m.height = reader.int32("height");
  m.data_size = reader.int32("data_size");
  return m;
}

/// The ranges are wider than any camera's; inside them every factor below is a finite float.
std::optional<Refusal> check_calibration(const Members& m) {
  struct Rule {
    const char* member;
    double value, min, max;
  };
  const Rule rules[] = {{"depth_scale", m.depth_scale, 1e-9, 1},
                        {"fx", m.fx, 1e-3, 1e7},
                        {"fy", m.fy, 1e-3, 1e7},
                        {"cx", m.cx, -1e7, 1e7},
                        {"cy", m.cy, -1e7, 1e7}};
  for (const Rule& rule : rules) {
    if (rule.value >= rule.min && rule.value <= rule.max) continue;  // false for NaN
    return refuse(RefusalReason::kBadCalibration, "depth_image_t." + std::string(rule.member),
                  "no camera's (got " + number(rule.value) + ", expected " + number(rule.min) + " to " +
                      number(rule.max) + ")",
                  m.header);
  }
  return std::nullopt;
}

/// Without any pixels, intrinsics say nothing.
bool has_pixels(const Members& m) {
  return m.width > 0 && m.height > 0;
}

/// A message that passed every check: what is left is to unproject.
struct Parsed {
  Members members;
  std::span<const std::byte> data;
};

std::variant<Parsed, Refusal> parse(std::span<const std::byte> message, const DecodeLimits& limits) {
  ByteReader reader(message);
  reader.skip("fingerprint", kFingerprintBytes);
  Parsed parsed{read_members(reader, limits), {}};
  const Members& m = parsed.members;
  if (!reader.ok()) return refuse(reader, kType, m.header);
  const DataLayout layout{kType, m.width, m.height, sizeof(std::uint16_t), m.data_size, reader.remaining()};
  if (auto refusal = check_layout(layout, limits, m.header)) return *std::move(refusal);
  if (has_pixels(m)) {
    if (auto refusal = check_calibration(m)) return *std::move(refusal);
  }
  parsed.data = reader.bytes("data", reader.remaining());
  return parsed;
}

void unproject_pixels(std::span<const std::byte> data, const Members& m, PointCloud& cloud) {
  constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
  const auto scale = static_cast<float>(m.depth_scale);
  const auto depth_of = [scale](const std::byte* row, std::size_t u) {
    std::uint16_t depth = 0;
    std::memcpy(&depth, row + u * sizeof(depth), sizeof(depth));
    return depth == 0 ? kMissing : static_cast<float>(depth) * scale;
  };
  const std::size_t row_stride = static_cast<std::size_t>(m.width) * sizeof(std::uint16_t);
  unproject(data, row_stride, CameraIntrinsics{m.fx, m.fy, m.cx, m.cy}, depth_of, cloud);
}

}  // namespace

std::optional<Refusal> check_depth_image(std::span<const std::byte> message, const DecodeLimits& limits) {
  std::variant<Parsed, Refusal> parsed = parse(message, limits);
  if (auto* refusal = std::get_if<Refusal>(&parsed)) return std::move(*refusal);
  return std::nullopt;
}

std::variant<Frame, Refusal> decode_depth_image(std::span<const std::byte> message,
                                                const DecodeLimits& limits) {
  std::variant<Parsed, Refusal> parsed = parse(message, limits);
  if (auto* refusal = std::get_if<Refusal>(&parsed)) return std::move(*refusal);
  Members& m = std::get<Parsed>(parsed).members;
  Frame frame{m.header.utime, m.header.seq, std::move(m.header.frame_name), {}};
  frame.cloud.width = m.width;
  frame.cloud.height = m.height;
  frame.cloud.resize(static_cast<std::size_t>(m.width) * static_cast<std::size_t>(m.height));
  if (has_pixels(m)) unproject_pixels(std::get<Parsed>(parsed).data, m, frame.cloud);
  return frame;
}

}  // namespace graspd
