// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/frame_publisher.hpp"

#include <algorithm>
#include <stdexcept>

#include "client/common/stop_flag.hpp"
#include "client/common/text.hpp"
#include "service/transport/cloud_encoder.hpp"
#include "service/transport/seal_keys.hpp"

namespace graspd {

using Clock = std::chrono::steady_clock;

std::optional<MessageType> message_type(const std::string& name) {
  if (name == "cloud") return MessageType::kCloud;
  if (name == "depth") return MessageType::kDepth;
  return std::nullopt;
}

std::int64_t wall_clock_us() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

Pacer::Pacer(double rate_hz)
    : period_(rate_hz > 0 ? static_cast<std::int64_t>(1e9 / rate_hz) : 0), slot_(Clock::now()) {}

bool Pacer::next() {
  if (!wait_until(slot_)) return false;
  slot_ = std::max(slot_ + period_, Clock::now());
  return true;
}

void FramePublisher::sign_with(const std::filesystem::path& key_file) {
  sealer_.emplace(load_seal_keys(key_file).front());
}

void FramePublisher::send_cloud(const FrameHeader& header, const LabelledCloud& cloud) {
  send(encode(make_point_cloud(header, cloud.cloud, cloud.rgb, cloud.label)));
}

void FramePublisher::send_depth(const FrameHeader& header, const Pinhole& camera, std::span<const float> z_m,
                                double depth_scale_m) {
  const DepthCamera intrinsics{camera.width, camera.height, camera.fx,    camera.fy,
                               camera.cx,    camera.cy,     depth_scale_m};
  send(encode(make_depth_image(header, intrinsics, depth_units(z_m, depth_scale_m))));
}

void FramePublisher::send(std::span<const std::byte> bytes) {
  if (sealer_) bytes = sealer_->seal(channel_, bytes, wall_clock_us());
  if (!send_(channel_, bytes)) {
    throw std::runtime_error(
        printed("a message of %zu bytes on %s could not be sent", bytes.size(), channel_.c_str()));
  }
  last_ = Clock::now();
  if (frames_ == 0) first_ = last_;
  ++frames_;
  bytes_ += static_cast<std::int64_t>(bytes.size());
}

std::string FramePublisher::summary() const {
  const double seconds = std::chrono::duration<double>(last_ - first_).count();
  const double rate = seconds > 0 ? static_cast<double>(frames_ - 1) / seconds : 0;
  return printed("%lld frames, %.1f MB in %.1f s (%.1f Hz) on %s", static_cast<long long>(frames_),
                 1e-6 * static_cast<double>(bytes_), seconds, rate, channel_.c_str());
}

}  // namespace graspd
