// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Sends clouds at a rate, as either input type, and counts what went out.
#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "client/common/cloud_file.hpp"
#include "client/common/pinhole.hpp"
#include "service/transport/frame.hpp"
#include "service/transport/lcm_bus.hpp"
#include "service/transport/sealer.hpp"

namespace graspd {

/// The types of message that carry a frame.
enum class MessageType { kCloud, kDepth };
[[nodiscard]] std::optional<MessageType> message_type(const std::string& name);

/// Microseconds since 1970.
[[nodiscard]] std::int64_t wall_clock_us();

/// Slots of equal length on the steady clock; a slot that was missed is not made up for.
class Pacer {
 public:
  /// rate_hz 0: no waiting. The first slot is at once.
  explicit Pacer(double rate_hz);

  /// Waits for the next slot; false when a stop was requested.
  [[nodiscard]] bool next();

 private:
  std::chrono::nanoseconds period_;
  std::chrono::steady_clock::time_point slot_;
};

class FramePublisher {
 public:
  /// Takes a message on its way; false: it could not be sent.
  using Send = std::function<bool(const std::string& channel, std::span<const std::byte> bytes)>;

  FramePublisher(Send send, std::string channel) : send_(std::move(send)), channel_(std::move(channel)) {}
  FramePublisher(LcmBus& bus, std::string channel)
      : FramePublisher([&bus](const std::string& name,
                              std::span<const std::byte> bytes) { return bus.publish(name, bytes); },
                       std::move(channel)) {}

  /// Sealed with the first key of a file from now on. Throws std::runtime_error when there is none.
  void sign_with(const std::filesystem::path& key_file);

  /// As point_cloud_t, with colours and labels when there are any.
  void send_cloud(const FrameHeader& header, const LabelledCloud& cloud);

  /// As depth_image_t.
  void send_depth(const FrameHeader& header, const Pinhole& camera, std::span<const float> z_m,
                  double depth_scale_m);

  [[nodiscard]] std::int64_t frames() const { return frames_; }

  /// "45 frames, 172.6 MB in 4.4 s (10.0 Hz) on GRASPD_CLOUD".
  [[nodiscard]] std::string summary() const;

 private:
  void send(std::span<const std::byte> bytes);

  Send send_;
  std::string channel_;
  std::optional<Sealer> sealer_;
  std::int64_t frames_ = 0;
  std::int64_t bytes_ = 0;
  std::chrono::steady_clock::time_point first_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace graspd
