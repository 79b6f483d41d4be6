// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Whose segments somebody wants to see now.
#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "graspd/segmentation_request_t.hpp"
#include "service/runtime/clock.hpp"

namespace graspd {

/// Belongs to the LCM thread.
class SegmentationRequests {
 public:
  static constexpr std::size_t kMostChannels = 1024;

  /// Holds for the request's seconds from now; a shorter one takes nothing from a longer one. False when it
  /// is for one channel more than kMostChannels.
  [[nodiscard]] bool add(const segmentation_request_t& request, Clock::TimePoint now);

  [[nodiscard]] bool wants(std::string_view channel, Clock::TimePoint now) const;

 private:
  std::map<std::string, Clock::TimePoint, std::less<>> until_;  // by channel; under no name: all
};

}  // namespace graspd
