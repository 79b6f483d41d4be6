// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What one message led to: the list to publish, and how it is counted.
#pragma once
#include <cstdint>
#include <optional>

#include "graspd/handle_list_t.hpp"
#include "service/runtime/clock.hpp"
#include "service/transport/refusal.hpp"

namespace graspd {

enum class Outcome : std::uint8_t {
  kProcessed,  ///< went through the pipeline, with or without handles
  kFailed,     ///< the pipeline threw; counted as processed
  kRefused,    ///< not a usable message
  kDropped,    ///< not looked at: overload, or the daemon stops
};

struct Answer {
  Outcome outcome = Outcome::kProcessed;
  std::optional<RefusalReason> refusal;  ///< with kRefused
  Clock::TimePoint arrival{};            ///< of the message
  handle_list_t list;                    ///< complete but for the latency
};

}  // namespace graspd
