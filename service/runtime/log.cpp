// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/log.hpp"

#include <spdlog/async.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <algorithm>
#include <thread>

namespace graspd {
namespace {

class FunctionSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit FunctionSink(std::function<void(const std::string&)> write) : write_(std::move(write)) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    write_(std::string(message.payload.data(), message.payload.size()));
  }
  void flush_() override {}

  std::function<void(const std::string&)> write_;
};

bool is_plain(char c) {
  return c > ' ' && c < 0x7f && c != '"' && c != '\\' && c != '=';
}

std::string quoted_if_needed(const std::string& value) {
  if (!value.empty() && std::all_of(value.begin(), value.end(), is_plain)) return value;
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') text += '\\';
    text += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return text + '"';
}

}  // namespace

std::string format_fields(std::string_view event, std::initializer_list<LogField> fields) {
  std::string line = "event=" + std::string(event);
  for (const LogField& field : fields) line += " " + field.key + "=" + quoted_if_needed(field.value);
  return line;
}

Log::Log(const Clock& clock, std::size_t max_lines)
    : clock_(clock),
      writer_(std::make_shared<spdlog::details::thread_pool>(max_lines, 1)),
      logger_(
          std::make_shared<spdlog::async_logger>("graspd", std::make_shared<spdlog::sinks::stderr_sink_mt>(),
                                                 writer_, spdlog::async_overflow_policy::overrun_oldest)) {
  logger_->set_pattern("%Y-%m-%dT%H:%M:%S.%eZ level=%l %v", spdlog::pattern_time_type::utc);
  logger_->flush_on(spdlog::level::info);
}

Log::Log(const Clock& clock, std::function<void(const std::string&)> sink)
    : clock_(clock),
      logger_(std::make_shared<spdlog::logger>("graspd", std::make_shared<FunctionSink>(std::move(sink)))) {}

Log::~Log() = default;

void Log::info(std::string_view event, std::initializer_list<LogField> fields) {
  write(LogLevel::kInfo, event, fields);
}

void Log::warning(std::string_view event, std::initializer_list<LogField> fields) {
  write(LogLevel::kWarning, event, fields);
}

void Log::error(std::string_view event, std::initializer_list<LogField> fields) {
  write(LogLevel::kError, event, fields);
}

void Log::write(LogLevel level, std::string_view event, std::initializer_list<LogField> fields) {
  std::string line = format_fields(event, fields);
  const std::int64_t suppressed = admit(event, level, line);
  if (suppressed < 0) return;
  if (suppressed > 0) line += " suppressed=" + std::to_string(suppressed);
  const auto spdlog_level = level == LogLevel::kInfo      ? spdlog::level::info
                            : level == LogLevel::kWarning ? spdlog::level::warn
                                                          : spdlog::level::err;
  logger_->log(spdlog_level, spdlog::string_view_t(line.data(), line.size()));
}

std::int64_t Log::admit(std::string_view event, LogLevel level, const std::string& line) {
  const std::lock_guard lock(mutex_);
  const Clock::TimePoint now = clock_.now();
  auto [at, is_new] = kinds_.try_emplace(std::string(event));
  Kind& kind = at->second;
  if (level != LogLevel::kInfo) {
    const std::int64_t count = kind.report ? kind.report->count : 0;
    kind.report = {clock_.wall_utime(), at->first, line.substr(0, kLongestReport), count + 1};
  }
  if (is_new || now - kind.since >= kPeriod) {
    const std::int64_t suppressed = kind.suppressed;
    kind.since = now;
    kind.lines = 1;
    kind.suppressed = 0;
    return suppressed;
  }
  if (kind.lines < kLinesAPeriod) {
    ++kind.lines;
    return 0;
  }
  ++kind.suppressed;
  return -1;
}

std::vector<LogReport> Log::reports() const {
  std::vector<LogReport> reports;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [event, kind] : kinds_)
      if (kind.report) reports.push_back(*kind.report);
  }
  std::sort(reports.begin(), reports.end(),
            [](const LogReport& a, const LogReport& b) { return a.utime > b.utime; });
  if (reports.size() > kMostReports) reports.resize(kMostReports);
  return reports;
}

bool Log::flush() {
  logger_->flush();
  if (!writer_) return true;
  // The writer takes one after the other: when it has taken the flush, all before it is written.
  const auto deadline = std::chrono::steady_clock::now() + kFlushLimit;
  while (writer_->queue_size() > 0) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

std::int64_t Log::lost() const {
  return writer_ ? static_cast<std::int64_t>(writer_->overrun_counter()) : 0;
}

}  // namespace graspd
