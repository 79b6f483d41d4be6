// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/replay/random_log.hpp"

#include <algorithm>
#include <span>

namespace graspd {
namespace {

/// Bytes among which there are beginnings of headers.
std::string random_bytes(Rng& rng, std::size_t most) {
  std::string bytes(static_cast<std::size_t>(rng.uniform() * static_cast<double>(most)), '\0');
  for (char& byte : bytes) byte = static_cast<char>(rng.bits());
  if (bytes.size() > 8) bytes.replace(bytes.size() / 2, 4, "\xed\xa1\xda\x01", 4);
  return bytes;
}

void damage(std::string& log, Rng& rng) {
  const auto at = static_cast<std::size_t>(rng.uniform() * static_cast<double>(log.size()));
  const int kind = rng.index(3);
  if (kind == 0) log.insert(at, random_bytes(rng, 2000));
  if (kind == 1) log.erase(at, 40);
  if (const auto sync = log.find("\xed\xa1\xda\x01", at); kind == 2 && sync != log.npos) log[sync] = '\0';
}

}  // namespace

std::int64_t write_random_log(const std::filesystem::path& path, Rng& rng, const RandomLogConfig& config) {
  std::int64_t utime = config.start_utime;
  {
    EventLogFile log(path, EventLogFile::Existing::kOverwrite);
    for (int i = 0; i < config.events; ++i) {
      utime += static_cast<std::int64_t>(rng.uniform() * static_cast<double>(config.most_step_us));
      const std::int64_t early =
          rng.index(4) == 0 ? rng.index(static_cast<int>(config.most_early_us) + 1) : 0;
      const std::string bytes = random_bytes(rng, config.most_bytes);
      log.write(utime - early, rng.index(3) == 0 ? "GRASPD_CLOUD" : "OTHER", std::as_bytes(std::span(bytes)));
    }
  }
  std::string bytes = read_bytes(path);
  for (int i = 0; i < config.damages; ++i) damage(bytes, rng);
  write_bytes(path, bytes);
  return utime;
}

std::vector<FoundEvent> events_between(const std::vector<LogPart>& parts, std::int64_t from,
                                       std::int64_t to) {
  std::vector<FoundEvent> events;
  Archive archive(parts);
  EventHead head;
  while (archive.next_head(head))
    if (head.recv_utime >= from && head.recv_utime < to)
      events.emplace_back(parts[archive.part()].path.filename(), head.position, head.recv_utime,
                          head.channel);
  return events;
}

std::int64_t bytes_of_parts(const std::vector<LogPart>& parts) {
  std::int64_t sum = 0;
  for (const LogPart& part : parts) {
    const auto size = static_cast<std::int64_t>(std::filesystem::file_size(part.path));
    sum += std::min(part.part.end, size) - std::min(part.part.begin, size);
  }
  return sum;
}

}  // namespace graspd
