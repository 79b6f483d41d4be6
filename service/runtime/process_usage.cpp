// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/process_usage.hpp"

#include <sys/resource.h>

#include <charconv>
#include <filesystem>
#include <string>
#include <system_error>

#include "service/runtime/file_text.hpp"

namespace graspd {
namespace {

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

int open_descriptors() {
  std::error_code error;
  const std::filesystem::directory_iterator entries("/proc/self/fd", error);
  if (error) return 0;
  // One of them is the iterator's own.
  return static_cast<int>(std::distance(begin(entries), end(entries))) - 1;
}

}  // namespace

std::int64_t status_bytes(std::string_view status_text, std::string_view key) {
  return status_number(status_text, key) * 1024;
}

std::int64_t status_number(std::string_view status_text, std::string_view key) {
  const std::string start = std::string(key) + ":";
  std::size_t at = status_text.starts_with(start) ? 0 : status_text.find("\n" + start);
  if (at == std::string_view::npos) return 0;
  at = status_text.find_first_of("0123456789", at + start.size());
  if (at == std::string_view::npos) return 0;
  std::int64_t number = 0;
  std::from_chars(status_text.data() + at, status_text.data() + status_text.size(), number);
  return number;
}

double process_cpu_seconds() {
  rusage times{};
  getrusage(RUSAGE_SELF, &times);
  return seconds_of(times.ru_utime) + seconds_of(times.ru_stime);
}

ProcessUsage ProcessUsageMeter::measure(Clock::TimePoint now) {
  ProcessUsage usage;
  const std::string text = file_text("/proc/self/status");
  usage.rss_bytes = status_bytes(text, "VmRSS");
  usage.peak_rss_bytes = status_bytes(text, "VmHWM");
  usage.threads = static_cast<int>(status_number(text, "Threads"));
  usage.descriptors = open_descriptors();
  const double cpu_s = process_cpu_seconds();
  const double elapsed_s = seconds(now - last_time_);
  if (started_ && elapsed_s > 0) usage.cpu = (cpu_s - last_cpu_s_) / elapsed_s;
  last_cpu_s_ = cpu_s;
  last_time_ = now;
  started_ = true;
  return usage;
}

}  // namespace graspd
