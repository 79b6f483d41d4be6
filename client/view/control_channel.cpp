// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/view/control_channel.hpp"

#include <algorithm>
#include <utility>

#include "client/common/frame_publisher.hpp"
#include "service/transport/control_codec.hpp"
#include "service/transport/seal_keys.hpp"

namespace graspd {

ControlChannel::ControlChannel(Bus& bus, std::string channel, const std::string& key_file)
    : bus_(bus), channel_(std::move(channel)) {
  if (!key_file.empty()) sealer_.emplace(load_seal_keys(key_file).front());
}

std::optional<std::int64_t> ControlChannel::send(std::int8_t command, const std::string& text) {
  control_t control;
  control.utime = wall_clock_us();
  control.id = last_id_ = std::max(last_id_ + 1, control.utime);
  control.command = command;
  control.text = text;
  if (!publish(channel_, encode(control))) return std::nullopt;
  return control.id;
}

bool ControlChannel::publish(const std::string& channel, std::span<const std::byte> message) {
  return bus_.publish(channel, sealer_ ? sealer_->seal(channel, message, wall_clock_us()) : message);
}

}  // namespace graspd
