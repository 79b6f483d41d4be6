// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/log/time_search.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "client/common/text.hpp"

namespace graspd {
namespace {

constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();

std::int64_t earlier(std::int64_t utime, std::int64_t by) {
  return utime < kLeast + by ? kLeast : utime - by;
}
std::int64_t later(std::int64_t utime, std::int64_t by) {
  return utime > kMost - by ? kMost : utime + by;
}

}  // namespace

TimeSearch::TimeSearch(std::filesystem::path log, const EventLogReader::Part& part,
                       const TimeSearchConfig& config)
    : log_(std::move(log)), part_(part), config_(config) {
  const std::int64_t size = EventLogReader(log_).size();
  part_.end = std::clamp<std::int64_t>(part.end, 0, size);
  part_.begin = std::clamp<std::int64_t>(part.begin, 0, part_.end);
}

bool TimeSearch::sample(std::int64_t begin, std::int64_t end) {
  EventLogReader reader(log_, {begin, end});
  EventHead head;
  while (reader.next_head(head)) {
    const std::int64_t follows = reader.position();
    EventHead next;
    if (follows < part_.end && !EventLogReader(log_, {follows, follows + 1}).next_head(next)) continue;
    last_sample_ = samples_.emplace(head.position, head.recv_utime).first;
    return true;
  }
  return false;
}

void TimeSearch::sample_ends() {
  if (std::exchange(ends_known_, true) || !sample(part_.begin, part_.end)) return;
  // The last event: from an event near the end on, all of them.
  constexpr std::int64_t kLeastBytes = 64 << 10;
  for (std::int64_t bytes = kLeastBytes;; bytes *= 4) {
    const std::int64_t begin = std::max(part_.begin, part_.end - bytes);
    if (!sample(begin, part_.end) && begin > part_.begin) continue;
    EventLogReader reader(log_, {last_sample_->first, part_.end});
    EventHead head;
    while (reader.next_head(head))
      last_sample_ = samples_.emplace_hint(samples_.end(), head.position, head.recv_utime);
    return;
  }
}

void TimeSearch::sample_all() {
  if (std::exchange(all_sampled_, true)) return;
  const std::int64_t step =
      std::max(config_.sample_bytes, (part_.end - part_.begin) / config_.most_samples + 1);
  // Where there are no events for long, nothing is read twice.
  for (std::int64_t at = part_.begin + step; at < part_.end && sample(at, part_.end);)
    at = std::max(at, last_sample_->first) + step;
}

TimeSearch::Bracket TimeSearch::bracket(std::int64_t utime) {
  auto after =
      std::find_if(samples_.begin(), samples_.end(), [&](const auto& s) { return s.second >= utime; });
  auto before = std::prev(after);
  std::int64_t end = after->first;  // no event is known to begin from here to `after`
  while (end - before->first > config_.narrow_bytes) {
    const std::int64_t middle = before->first + (end - before->first) / 2;
    if (!sample(middle, end)) {
      end = middle;
    } else if (last_sample_->second < utime) {
      before = last_sample_;
    } else {
      after = last_sample_;
      end = middle;
    }
  }
  return {before->first, after->first};
}

void TimeSearch::check_order() {
  std::int64_t latest = kLeast;
  for (const auto& [position, utime] : samples_) {
    if (later(utime, config_.disorder_us) < latest) {
      disorder_ = printed("%s: times go backwards (by %.1f s before byte %lld): all of it is read",
                          log_.c_str(), 1e-6 * (static_cast<double>(latest) - static_cast<double>(utime)),
                          static_cast<long long>(position));
      return;
    }
    latest = std::max(latest, utime);
  }
}

EventLogReader::Part TimeSearch::stretch(std::int64_t from_utime, std::int64_t to_utime) {
  sample_ends();
  if (samples_.empty() || !disorder_.empty()) return part_;
  const std::int64_t from = earlier(from_utime, config_.disorder_us);
  const std::int64_t to = later(to_utime, config_.disorder_us);
  const std::int64_t first = samples_.begin()->second, last = samples_.rbegin()->second;
  EventLogReader::Part found = part_;
  if (last < from || first >= to) {
    found.begin = part_.end;
  } else {
    sample_all();
    if (first < from) found.begin = bracket(from).before;
    if (last >= to) found.end = bracket(to).after;
  }
  check_order();
  return disorder_.empty() ? found : part_;
}

std::optional<std::int64_t> TimeSearch::last_utime() {
  sample_ends();
  return samples_.empty() ? std::nullopt : std::optional(samples_.rbegin()->second);
}

}  // namespace graspd
