// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/archive_search.hpp"

#include <algorithm>
#include <limits>

namespace graspd {

ArchiveSearch::ArchiveSearch(const std::vector<LogPart>& parts, const TimeSearchConfig& config)
    : parts_(parts) {
  searches_.reserve(parts.size());
  for (const LogPart& part : parts) searches_.emplace_back(part.path, part.part, config);
}

std::vector<LogPart> ArchiveSearch::stretch(std::int64_t from_utime, std::int64_t to_utime) {
  std::vector<LogPart> found = parts_;
  for (std::size_t i = 0; i < found.size(); ++i) found[i].part = searches_[i].stretch(from_utime, to_utime);
  return found;
}

std::vector<LogPart> ArchiveSearch::rest(std::int64_t from_utime) {
  std::vector<LogPart> found = parts_;
  for (std::size_t i = 0; i < found.size(); ++i) {
    found[i].part = searches_[i].stretch(from_utime, std::numeric_limits<std::int64_t>::max());
    if (searches_[i].last_utime() >= from_utime) break;
  }
  return found;
}

std::vector<std::string> ArchiveSearch::notes() const {
  std::vector<std::string> notes;
  for (const TimeSearch& search : searches_)
    if (!search.disorder().empty()) notes.push_back(search.disorder());
  return notes;
}

std::int64_t total_bytes(const std::vector<LogPart>& parts) {
  std::int64_t sum = 0;
  for (const LogPart& part : parts) {
    const std::int64_t end = std::min(part.part.end, EventLogReader(part.path).size());
    sum += std::max<std::int64_t>(0, end - part.part.begin);
  }
  return sum;
}

}  // namespace graspd
