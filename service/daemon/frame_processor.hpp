// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One message's way: bytes, decode, detect_handles, handle list.
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "service/config/source_config.hpp"
#include "service/daemon/answer.hpp"
#include "service/runtime/clock.hpp"
#include "service/transport/frame.hpp"
#include "service/transport/handle_list_codec.hpp"
#include "service/transport/refusal.hpp"

namespace graspd {

/// A message that has arrived.
struct FrameMessage {
  FrameHeader header;
  std::pmr::vector<std::byte> bytes;
  Clock::TimePoint arrival{};
  bool segments_requested = false;  ///< by somebody who wants to see them
};

/// How much work a frame is worth now.
enum class Effort : std::uint8_t {
  kFull,      ///< as configured
  kDegraded,  ///< with the source's degraded voxels
};

/// For one channel of one source, with one configuration. Its functions may be called from several threads at
/// once.
class FrameProcessor {
 public:
  /// `revision` of the configuration.
  FrameProcessor(const SourceConfig& source, std::string channel, const DecodeLimits& limits,
                 const Clock& clock, std::int64_t revision);

  /// What process() would refuse, as far as that can be told in microseconds.
  [[nodiscard]] std::optional<Refusal> check(std::span<const std::byte> message) const;

  /// Exceptions from the frame become an answer FAILED. When `cancelled` becomes true the frame ends after
  /// the stage it is in, as dropped.
  [[nodiscard]] Answer process(const FrameMessage& message, Effort effort,
                               const std::atomic<bool>& cancelled) const;

  /// For messages that are not processed.
  [[nodiscard]] Answer refuse(const Refusal& refusal, Clock::TimePoint arrival) const;
  [[nodiscard]] Answer drop(const FrameMessage& message, DropReason reason, const std::string& why) const;
  [[nodiscard]] Answer fail(const FrameMessage& message, const std::string& why) const;

  /// When the frame is too late; nothing: never.
  [[nodiscard]] std::optional<Clock::TimePoint> deadline(const FrameMessage& message) const;

 private:
  struct Cancelled {};

  Answer detect(const FrameMessage& message, Effort effort, const std::atomic<bool>& cancelled) const;
  [[nodiscard]] bool publishes_segments(const FrameMessage& message) const;
  HandleListHeader list_header(const FrameHeader& header) const;
  Answer make_answer(Outcome outcome, const HandleListHeader& header, const Detection& detection,
                     Clock::TimePoint arrival) const;

  const SourceConfig source_;
  const DetectConfig degraded_detect_;
  const std::string channel_;
  const DecodeLimits limits_;
  const Clock& clock_;
  const std::int64_t revision_;
};

}  // namespace graspd
