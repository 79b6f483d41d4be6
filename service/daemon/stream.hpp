// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One channel that clouds come on: what belongs to it from arrival to answer.
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "service/daemon/answer.hpp"
#include "service/daemon/frame_processor.hpp"
#include "service/daemon/health.hpp"
#include "service/runtime/in_order_gate.hpp"

namespace graspd {

struct Stream {
  using Publish = std::function<void(Stream&, Answer)>;

  /// `publish` as in InOrderGate.
  Stream(std::size_t source_index, std::string channel_name, std::size_t queue_number,
         FrameProcessor frame_processor, const Publish& publish)
      : source(source_index),
        channel(std::move(channel_name)),
        queue(queue_number),
        processor(std::move(frame_processor)),
        gate([this, publish](Answer answer) { publish(*this, std::move(answer)); }) {}

  const std::size_t source;  ///< index in the configuration
  const std::string channel;
  const std::size_t queue;  ///< number in the frame queue
  const FrameProcessor processor;
  ChannelHealth health;
  InOrderGate<Answer> gate;
};

/// A message on its way through the queue. Streams outlive their messages.
struct Job {
  Stream* stream = nullptr;
  InOrderGate<Answer>::Ticket ticket = 0;
  FrameMessage message;
};

}  // namespace graspd
