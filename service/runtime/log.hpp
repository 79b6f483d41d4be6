// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// One line a event on standard error, as key=value, and not too many of one kind.
#pragma once
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "service/runtime/clock.hpp"

namespace spdlog {
class logger;
}

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

/// May be used from any thread. Of one event kLinesAPeriod lines go out in each period; the first one after
/// that says how many were suppressed.
class Log {
 public:
  static constexpr int kLinesAPeriod = 10;
  static constexpr std::chrono::seconds kPeriod{10};

  /// To standard error.
  explicit Log(const Clock& clock);
  /// To a function instead, one line without its end a call.
  Log(const Clock& clock, std::function<void(const std::string&)> sink);
  ~Log();

  void info(std::string_view event, std::initializer_list<LogField> fields = {});
  void warning(std::string_view event, std::initializer_list<LogField> fields = {});
  void error(std::string_view event, std::initializer_list<LogField> fields = {});

 private:
  struct Kind {
    Clock::TimePoint since;
    int lines = 0;
    std::int64_t suppressed = 0;
  };
  void write(LogLevel level, std::string_view event, std::initializer_list<LogField> fields);
  /// How many lines of the event were held back before this one; negative: this one is as well.
  std::int64_t admit(std::string_view event);

  const Clock& clock_;
  std::unique_ptr<spdlog::logger> logger_;
  std::mutex mutex_;
  std::map<std::string, Kind, std::less<>> kinds_;
};

/// key=value pairs; values with anything but plain characters in double quotes, on one line in any case.
[[nodiscard]] std::string format_fields(std::string_view event, std::initializer_list<LogField> fields);

}  // namespace graspd
