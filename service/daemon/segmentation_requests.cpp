// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/segmentation_requests.hpp"

#include <algorithm>
#include <chrono>

namespace graspd {

bool SegmentationRequests::add(const segmentation_request_t& request, Clock::TimePoint now) {
  std::erase_if(until_, [now](const auto& entry) { return entry.second <= now; });
  if (until_.size() >= kMostChannels && !until_.contains(request.source_channel)) return false;
  const auto until = now + std::chrono::duration_cast<Clock::TimePoint::duration>(
                               std::chrono::duration<double>(request.seconds));
  Clock::TimePoint& entry = until_.try_emplace(request.source_channel, until).first->second;
  entry = std::max(entry, until);
  return true;
}

bool SegmentationRequests::wants(std::string_view channel, Clock::TimePoint now) const {
  const auto holds = [&](std::string_view key) {
    const auto found = until_.find(key);
    return found != until_.end() && now < found->second;
  };
  return holds("") || holds(channel);
}

}  // namespace graspd
