// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/view/frame_message.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>
#include <vector>

#include "client/common/cloud_colors.hpp"
#include "client/common/handle_text.hpp"
#include "client/common/json_writer.hpp"
#include "client/detect/explanation.hpp"
#include "service/pipeline/handle.hpp"
#include "service/transport/cloud_decoder.hpp"
#include "service/transport/segmentation_codec.hpp"

namespace graspd {
namespace {

static_assert(std::endian::native == std::endian::little, "the message is little-endian");

constexpr std::uint32_t kHasColors = 1;

/// Appends values as they are in memory.
class Packer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void put_all(std::span<const T> values) {
    text_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    align();
  }
  void reserve(std::size_t bytes) { text_.reserve(bytes); }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  void align() { text_.resize((text_.size() + 3) / 4 * 4); }
  std::string text_;
};

struct QuantizedPoints {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  float step = 0;                    ///< [m]
  std::vector<std::uint16_t> xyz;    ///< three a point
  std::vector<std::uint8_t> colors;  ///< three a point, or none
};

/// Which points are shown: finite ones, every n-th of them where there are too many.
std::vector<std::uint32_t> chosen_points(const PointCloud& cloud, std::size_t max_points) {
  std::vector<std::uint32_t> chosen;
  chosen.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud.point(i).allFinite()) chosen.push_back(static_cast<std::uint32_t>(i));
  const std::size_t n = (chosen.size() + max_points - 1) / std::max<std::size_t>(max_points, 1);
  if (n <= 1) return chosen;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < chosen.size(); i += n) chosen[kept++] = chosen[i];
  chosen.resize(kept);
  return chosen;
}

/// Points so far from the rest that they would cost it its precision are left out.
constexpr float kFarthest_m = 20;

QuantizedPoints quantized(const PointCloud& cloud, const std::vector<std::uint32_t>& colors,
                          const Eigen::Isometry3f& T_target_cloud, std::size_t max_points) {
  QuantizedPoints result;
  std::vector<Eigen::Vector3f> points;
  std::vector<std::uint32_t> indices;
  Eigen::AlignedBox3f box;
  for (const std::uint32_t i : chosen_points(cloud, max_points)) {
    if ((cloud.point(i) - cloud.viewpoint).squaredNorm() > kFarthest_m * kFarthest_m) continue;
    points.push_back(T_target_cloud * cloud.point(i));
    indices.push_back(i);
    box.extend(points.back());
  }
  if (points.empty()) return result;
  constexpr float kMost = 65535;
  result.origin = box.min();
  result.step = std::max(box.sizes().maxCoeff(), 1e-6f) / kMost;
  result.xyz.reserve(3 * points.size());
  for (const Eigen::Vector3f& point : points)
    for (const float offset : (point - result.origin).eval())
      result.xyz.push_back(static_cast<std::uint16_t>(std::clamp(offset / result.step + 0.5f, 0.f, kMost)));
  if (colors.size() != cloud.size()) return result;
  result.colors.reserve(3 * points.size());
  for (const std::uint32_t i : indices)
    for (const int shift : {16, 8, 0}) result.colors.push_back(static_cast<std::uint8_t>(colors[i] >> shift));
  return result;
}

template <class Values>
void write_floats(JsonWriter& json, std::string_view name, const Values& values) {
  json.key(name).begin_array();
  for (const auto v : values) json.value_float(static_cast<double>(v));
  json.end_array();
}

/// The last check that a candidate of the segment reached, for people; empty where one passed all.
std::string_view why(const segment_t& segment) {
  if (segment.num_handles > 0)
    return "left out of the list: too close to others, too many, or the score too low";
  if (segment.num_candidates == 0) return "no candidate: no place on it is worth a try";
  for (std::size_t i = 0; i < kNumFailures; ++i)
    if (name(static_cast<Failure>(i)) == segment.reason) return in_words(static_cast<Failure>(i));
  return segment.reason;
}

void write_segment(JsonWriter& json, const segment_t& segment) {
  json.begin_object().member("id", segment.id).member("object", segment.object);
  json.member("num_points", segment.num_points);
  write_floats(json, "centroid", segment.centroid);
  write_floats(json, "normal", segment.normal);
  write_floats(json, "major_axis", segment.major_axis);
  json.member("num_candidates", segment.num_candidates).member("num_handles", segment.num_handles);
  json.member("reason", segment.reason).member("why", why(segment)).key("failures").begin_object();
  for (const reason_count_t& failure : segment.failures) json.member(failure.reason, failure.count);
  json.end_object().end_object();
}

void write_segmentation(JsonWriter& json, const segmentation_t& segmentation) {
  json.key("segmentation").begin_object();
  json.key("voxel_size").value_float(segmentation.voxel_size);
  write_floats(json, "support_plane", segmentation.support_plane);
  json.key("segments").begin_array();
  for (const segment_t& segment : segmentation.segments) write_segment(json, segment);
  json.end_array().end_object();
}

std::string frame_json(const MatchedFrame& frame, const Frame& decoded,
                       const std::optional<segmentation_t>& segmentation,
                       const Eigen::Isometry3f& T_target_cloud) {
  const std::string_view frame_name =
      frame.list ? std::string_view(frame.list->frame_name) : decoded.frame_name;
  const Eigen::Vector3f viewpoint = T_target_cloud * decoded.cloud.viewpoint;
  const Eigen::Vector3f position = T_target_cloud.translation();
  const Eigen::Quaternionf q = quaternion(T_target_cloud.linear());
  JsonWriter json;
  json.begin_object().member("channel", frame.channel).member("utime", frame.header.utime);
  json.member("seq", frame.header.seq)
      .member("frame_name", frame_name)
      .member("cloud_frame_name", decoded.frame_name);
  json.key("camera").begin_object();
  write_floats(json, "position", position);
  write_floats(json, "orientation", std::array{q.w(), q.x(), q.y(), q.z()});
  json.end_object();
  write_floats(json, "viewpoint", viewpoint);
  json.member("points_in", static_cast<std::int64_t>(decoded.cloud.size()));
  if (frame.list) {
    json.key("list").begin_object();
    write_handle_list(json, *frame.list);
    json.end_object();
  }
  if (segmentation) write_segmentation(json, *segmentation);
  return json.end_object().str();
}

void put_grid(Packer& packer, const Eigen::Vector3f& origin, float step) {
  for (const float v : origin) packer.put(v);
  packer.put(step);
}

}  // namespace

std::variant<std::string, Refusal> make_frame_message(const MatchedFrame& frame, std::int64_t serial,
                                                      const Eigen::Isometry3f& T_target_cloud,
                                                      const FrameMessageOptions& options) {
  std::variant<Frame, Refusal> decoding = decode_cloud(frame.cloud, options.limits);
  if (auto* refusal = std::get_if<Refusal>(&decoding)) return std::move(*refusal);
  const Frame& decoded = std::get<Frame>(decoding);
  const QuantizedPoints points =
      quantized(decoded.cloud, cloud_colors(frame.cloud, options.limits), T_target_cloud, options.max_points);
  const std::optional<segmentation_t> segmentation = decode_segmentation(frame.segmentation);
  const std::span<const std::uint8_t> segmented =
      segmentation ? std::span<const std::uint8_t>(segmentation->data) : std::span<const std::uint8_t>();
  const std::string json = frame_json(frame, decoded, segmentation, T_target_cloud);
  Packer packer;
  packer.reserve(128 + json.size() + 2 * points.xyz.size() + points.colors.size() + segmented.size());
  for (const char c : {'G', 'V', 'F', '1'}) packer.put(c);
  packer.put(static_cast<std::uint32_t>(json.size()));
  packer.put(static_cast<std::uint32_t>(points.xyz.size() / 3));
  packer.put(static_cast<std::uint32_t>(segmented.size() / segmentation_t::POINT_BYTES));
  packer.put(points.colors.empty() ? 0 : kHasColors);
  packer.put(serial);
  put_grid(packer, points.origin, points.step);
  if (segmentation)
    put_grid(packer, Eigen::Vector3d(segmentation->origin).cast<float>(),
             static_cast<float>(segmentation->step));
  else
    put_grid(packer, Eigen::Vector3f::Zero(), 0);
  packer.put_all(std::span<const char>(json));
  packer.put_all(std::span<const std::uint16_t>(points.xyz));
  packer.put_all(std::span<const std::uint8_t>(points.colors));
  packer.put_all(segmented);
  return packer.take();
}

}  // namespace graspd
