// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/log/event_log_reader.hpp"
#include "client/log/time_search.hpp"

#include "tests/fuzz/scratch_file.hpp"

/// Every byte belongs to an event or is counted as skipped; a search for a time ends within the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kHeaderBytes = 28;
  const auto file = graspd::scratch_file(data, size);
  (void)graspd::is_event_log(file);
  graspd::EventLogReader reader(file);
  graspd::LoggedEvent event;
  std::size_t used = 0;
  while (reader.next(event)) {
    graspd::require(!event.channel.empty());
    used += kHeaderBytes + event.channel.size() + event.bytes.size();
  }
  graspd::require(used + static_cast<std::size_t>(reader.skipped_bytes()) == size);
  graspd::TimeSearch search(file, {}, {.disorder_us = 1, .sample_bytes = 40, .narrow_bytes = 40});
  for (const std::int64_t utime : {std::int64_t{0}, search.last_utime().value_or(1) / 2}) {
    const auto stretch = search.stretch(utime, utime + 1);
    graspd::require(stretch.begin >= 0 && stretch.begin <= stretch.end &&
                    stretch.end <= static_cast<std::int64_t>(size));
  }
  return 0;
}
