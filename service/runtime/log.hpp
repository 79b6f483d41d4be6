// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One line an event on standard error, as key=value, and not too many of one kind.
#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/runtime/clock.hpp"

namespace spdlog {
class logger;
namespace details {
class thread_pool;
}
}  // namespace spdlog

namespace graspd {

struct LogField {
  LogField(std::string_view k, std::string_view v) : key(k), value(v) {}
  LogField(std::string_view k, const char* v) : key(k), value(v) {}
  LogField(std::string_view k, std::int64_t v) : key(k), value(std::to_string(v)) {}
  LogField(std::string_view k, int v) : key(k), value(std::to_string(v)) {}
  LogField(std::string_view k, std::size_t v) : key(k), value(std::to_string(v)) {}

  std::string key;
  std::string value;
};

enum class LogLevel { kInfo, kWarning, kError };

/// The newest warning or error of a kind.
struct LogReport {
  std::int64_t utime = 0;  ///< [us] since 1970
  std::string event;
  std::string line;        ///< kLongestReport characters at most
  std::int64_t count = 0;  ///< since the start
};

/// May be used from any thread. Of one event kLinesAPeriod lines go out in each period; the first one after
/// that says how many were suppressed. Lines to standard error are written by a thread of their own, so that
/// nobody waits for whoever reads them; when `max_lines` wait, the oldest are lost.
class Log {
 public:
  static constexpr int kLinesAPeriod = 10;
  static constexpr std::chrono::seconds kPeriod{10};

  static constexpr std::size_t kLongestReport = 1000;
  static constexpr std::size_t kMostReports = 16;
  static constexpr std::chrono::milliseconds kFlushLimit{300};

  /// To standard error.
  Log(const Clock& clock, std::size_t max_lines);
  /// To a function instead, one line without its end a call.
  Log(const Clock& clock, std::function<void(const std::string&)> sink);
  ~Log();

  void info(std::string_view event, std::initializer_list<LogField> fields = {});
  void warning(std::string_view event, std::initializer_list<LogField> fields = {});
  void error(std::string_view event, std::initializer_list<LogField> fields = {});

  /// Warnings and errors by kind, those of the last time first, kMostReports at most; held back or not.
  [[nodiscard]] std::vector<LogReport> reports() const;
  /// Waits until all lines are written, for kFlushLimit at most; false: nobody reads them.
  bool flush();
  /// Lines that were lost because too many waited.
  [[nodiscard]] std::int64_t lost() const;

 private:
  struct Kind {
    Clock::TimePoint since;
    int lines = 0;
    std::int64_t suppressed = 0;
    std::optional<LogReport> report;
  };
  void write(LogLevel level, std::string_view event, std::initializer_list<LogField> fields);
  /// How many lines of the event were held back before this one; negative: this one is as well.
  std::int64_t admit(std::string_view event, LogLevel level, const std::string& line);

  const Clock& clock_;
  std::shared_ptr<spdlog::details::thread_pool> writer_;  // none with a function
  std::shared_ptr<spdlog::logger> logger_;
  mutable std::mutex mutex_;
  std::map<std::string, Kind, std::less<>> kinds_;
};

/// key=value pairs; values with anything but plain characters in double quotes, on one line in any case.
[[nodiscard]] std::string format_fields(std::string_view event, std::initializer_list<LogField> fields);

}  // namespace graspd
