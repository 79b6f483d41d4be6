// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What one message led to: the list to publish, and how it is counted.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/runtime/clock.hpp"
#include "service/transport/handle_list_codec.hpp"
#include "service/transport/refusal.hpp"

namespace graspd {

enum class Outcome : std::uint8_t {
  kProcessed,  ///< went through the pipeline, with or without handles
  kFailed,     ///< the pipeline threw or got stuck; counted as processed
  kRefused,    ///< not a usable message
  kDropped,    ///< not worked on, or not to the end
};

enum class DropReason : std::uint8_t {
  kNewerFrame,    ///< its place in the mailbox was needed
  kDeadline,      ///< older than the source allows
  kMemory,        ///< too many bytes wait
  kHeldUp,        ///< too many later answers wait for it
  kReconfigured,  ///< a new configuration has no place for it
  kStopping,      ///< the daemon stops
};
inline constexpr std::size_t kNumDropReasons = static_cast<std::size_t>(DropReason::kStopping) + 1;

/// lower_snake, as on the wire.
[[nodiscard]] std::string_view name(DropReason reason);

struct Answer {
  Outcome outcome = Outcome::kProcessed;
  std::optional<RefusalReason> refusal;   ///< with kRefused
  std::optional<DropReason> drop;         ///< with kDropped
  Clock::TimePoint arrival{};             ///< of the message
  bool degraded = false;                  ///< as the list says
  std::pmr::string status_text;           ///< as the list says
  std::string handles_channel;            ///< to publish the list on
  HandleListMessage list;                 ///< complete but for the latency
  std::string segments_channel{};         ///< to publish the next one on
  std::vector<std::byte> segmentation{};  ///< a message; empty: none, or nobody wants it
};

}  // namespace graspd
