// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/selection.hpp"

#include <charconv>
#include <cmath>
#include <string_view>

#include "service/config/config_error.hpp"

namespace graspd {
namespace {

template <class T>
T parse_number(std::string_view text, const std::string& option, const char* expected) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw ConfigError(option + ": got " + std::string(text) + ", expected " + expected);
  return value;
}

std::int64_t first_utime(const std::vector<LogPart>& parts) {
  Archive archive(parts);
  EventHead head;
  return archive.next_head(head) ? head.recv_utime : 0;
}

std::int64_t parse_time(std::string_view text, const std::string& option, const std::vector<LogPart>& parts) {
  constexpr double kLongest = 4e12;  // [s], so that microseconds fit
  const bool absolute = text.starts_with('@');
  const char* expected = "seconds since the first event, or @ and seconds since 1970";
  const auto seconds = parse_number<double>(text.substr(absolute ? 1 : 0), option, expected);
  if (!(std::abs(seconds) < kLongest)) throw ConfigError(option + ": expected " + std::string(expected));
  return std::llround(1e6 * seconds) + (absolute ? 0 : first_utime(parts));
}

}  // namespace

Selection parse_selection(const std::string& from, const std::string& to, const std::string& frames,
                          const std::vector<LogPart>& parts) {
  Selection selection;
  if (!from.empty()) selection.from_utime = parse_time(from, "--from", parts);
  if (!to.empty()) selection.to_utime = parse_time(to, "--to", parts);
  if (frames.empty()) return selection;
  const std::size_t colon = frames.find(':');
  if (colon == std::string::npos) throw ConfigError("--frames: got " + frames + ", expected A:B");
  const std::string_view text(frames);
  const std::string_view first = text.substr(0, colon), end = text.substr(colon + 1);
  if (!first.empty()) selection.first_frame = parse_number<std::int64_t>(first, "--frames", "A:B");
  if (!end.empty()) selection.end_frame = parse_number<std::int64_t>(end, "--frames", "A:B");
  return selection;
}

}  // namespace graspd
