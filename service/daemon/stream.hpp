// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One channel that clouds come on: what belongs to it from arrival to answer.
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "service/daemon/answer.hpp"
#include "service/daemon/frame_processor.hpp"
#include "service/daemon/health.hpp"
#include "service/runtime/byte_budget.hpp"
#include "service/runtime/in_order_gate.hpp"
#include "service/runtime/load_control.hpp"

namespace graspd {

struct Stream {
  using Publish = std::function<void(Stream&, Answer)>;

  /// `publish` as in InOrderGate.
  Stream(std::string channel_name, std::size_t queue_number, const Publish& publish)
      : channel(std::move(channel_name)),
        queue(queue_number),
        gate([this, publish](Answer answer) { publish(*this, std::move(answer)); }) {}

  const std::string channel;
  const std::size_t queue;  ///< number in the frame queue
  // The LCM thread's alone; each message takes along what was set when it arrived.
  std::size_t source = 0;    ///< index in the configuration
  std::string subscription;  ///< the expression whose messages are taken
  std::shared_ptr<const FrameProcessor> processor;
  // Any thread's.
  ChannelHealth health;
  LoadControl load;
  InOrderGate<Answer> gate;
};

/// A message on its way through the queue.
struct Job {
  std::shared_ptr<Stream> stream;
  std::shared_ptr<const FrameProcessor> processor;
  InOrderGate<Answer>::Ticket ticket = 0;
  FrameMessage message;
  ByteBudget::Lease lease{};
};

}  // namespace graspd
