// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Settings out to the daemon, as control messages.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "client/view/commands.hpp"
#include "client/view/settings.hpp"
#include "service/transport/bus.hpp"
#include "service/transport/sealer.hpp"

namespace graspd {

class ControlChannel {
 public:
  /// key_file: to seal with; empty: nothing is sealed. Throws std::runtime_error where it cannot be read.
  ControlChannel(Bus& bus, std::string channel, const std::string& key_file);

  /// The number of the message that went out; a daemon's status repeats it. Nothing when it could not be
  /// sent.
  std::optional<std::int64_t> send(std::int8_t command, const std::string& text);

  /// Any message, sealed where all are.
  bool publish(const std::string& channel, std::span<const std::byte> message);

 private:
  Bus& bus_;
  std::string channel_;
  std::optional<Sealer> sealer_;
  std::int64_t last_id_ = 0;
};

}  // namespace graspd
