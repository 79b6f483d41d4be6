// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/status/prometheus.hpp"

#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "client/common/text.hpp"

namespace graspd {
namespace {

using Labels = std::vector<std::pair<std::string_view, std::string_view>>;

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\' || c == '"') result += '\\';
    if (c == '\n') {
      result += "\\n";
    } else {
      result += c;
    }
  }
  return result;
}

std::string number(double value) {
  return printed("%.17g", value);
}
std::string number(std::int64_t value) {
  return printed("%lld", static_cast<long long>(value));
}
std::string number(std::int32_t value) {
  return printed("%d", value);
}

/// Writes one family after the other.
class Metrics {
 public:
  void family(std::string_view name, std::string_view type, std::string_view help) {
    name_ = "graspd_" + std::string(name);
    text_ +=
        "# HELP " + name_ + " " + std::string(help) + "\n# TYPE " + name_ + " " + std::string(type) + '\n';
  }
  template <class Number>
  void sample(const Labels& labels, Number value) {
    text_ += name_;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      text_ += i == 0 ? "{" : ",";
      text_ += std::string(labels[i].first) + "=\"" + escaped(labels[i].second) + '"';
    }
    text_ += (labels.empty() ? " " : "} ") + number(value) + '\n';
  }
  template <class Number>
  void single(std::string_view name, std::string_view type, std::string_view help, Number value) {
    family(name, type, help);
    sample({}, value);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string name_;
  std::string text_;
};

Labels labels_of(const source_status_t& source) {
  return {{"source", source.name}, {"channel", source.channel}};
}

Labels with(Labels labels, std::string_view name, std::string_view value) {
  labels.emplace_back(name, value);
  return labels;
}

void write_up(Metrics& metrics, std::int32_t up) {
  metrics.single("up", "gauge", "Whether the daemon was heard.", up);
}

void write_process(Metrics& m, const status_t& s) {
  m.family("info", "gauge", "The daemon that was heard.");
  m.sample({{"version", s.version}, {"host", s.host}}, std::int32_t{1});
  m.single("uptime_seconds", "gauge", "Time since the start.", s.uptime);
  m.single("cpu_cores", "gauge", "Processor time used over the last second; 1 is one core.", s.cpu);
  m.single("resident_memory_bytes", "gauge", "Resident memory.", s.rss);
  m.single("peak_resident_memory_bytes", "gauge", "Largest resident memory so far.", s.peak_rss);
  m.single("threads", "gauge", "Threads of the process.", s.num_threads);
  m.single("open_descriptors", "gauge", "Open files and sockets.", s.num_descriptors);
  m.single("workers", "gauge", "Frames in work at the same time at most.", s.num_workers);
  m.single("stuck_frames", "gauge", "Frames in work for longer than watchdog_s.", s.num_stuck);
  m.single("waiting_bytes", "gauge", "Messages that wait or are in work.", s.waiting_bytes);
  m.single("config_revision", "gauge", "1 at the start, one more with every configuration taken.",
           s.config_revision);
  m.single("config_refused", "gauge", "Whether the newest reload or control message was not taken.",
           std::int32_t{s.config_error.empty() ? 0 : 1});
}

void write_losses(Metrics& m, const status_t& s) {
  if (s.receive_errors >= 0)
    m.single("kernel_receive_errors_total", "counter", "Datagrams lost because a receive buffer was full.",
             s.receive_errors);
  if (s.reassembly_errors >= 0)
    m.single("kernel_reassembly_errors_total", "counter", "Datagrams lost because a piece was missing.",
             s.reassembly_errors);
  m.single("reconnects_total", "counter", "Times that the bus was lost and made anew.", s.reconnects);
  m.single("log_lines_lost_total", "counter", "Lines that the log could not take.", s.log_lost);
  m.single("ignored_messages_total", "counter", "Messages on channels beyond the configured number.",
           s.ignored);
  m.family("events_total", "counter", "Warnings and errors by kind.");
  for (const error_report_t& error : s.errors) m.sample({{"event", error.event}}, error.count);
}

/// One family with a value of each source.
void write_each(Metrics& m, const status_t& status, std::string_view name, std::string_view type,
                std::string_view help, const std::function<void(const source_status_t&)>& sample) {
  m.family(name, type, help);
  for (const source_status_t& source : status.sources) sample(source);
}

void write_source_counters(Metrics& m, const status_t& status) {
  const auto count = [&](std::string_view name, std::string_view help,
                         std::int64_t source_status_t::*member) {
    write_each(m, status, name, "counter", help,
               [&](const source_status_t& s) { m.sample(labels_of(s), s.*member); });
  };
  const auto by_reason = [&](std::string_view name, std::string_view help,
                             std::vector<reason_count_t> source_status_t::*member) {
    write_each(m, status, name, "counter", help, [&](const source_status_t& s) {
      for (const reason_count_t& entry : s.*member)
        m.sample(with(labels_of(s), "reason", entry.reason), entry.count);
    });
  };
  count("frames_received_total", "Messages that arrived.", &source_status_t::received);
  count("frames_processed_total", "Frames that went through the pipeline.", &source_status_t::processed);
  count("frames_failed_total", "Processed frames that ended in an error.", &source_status_t::failed);
  count("frames_coarse_total", "Processed frames with coarser voxels than configured.",
        &source_status_t::coarse);
  count("frames_lost_total", "Missing sequence numbers.", &source_status_t::lost);
  by_reason("frames_dropped_total", "Frames not worked on, or not to the end.", &source_status_t::drops);
  by_reason("frames_refused_total", "Messages that could not be used.", &source_status_t::refusals);
}

void write_source_gauges(Metrics& m, const status_t& status) {
  const auto gauge = [&](std::string_view name, std::string_view help, const auto& value) {
    write_each(m, status, name, "gauge", help,
               [&](const source_status_t& s) { m.sample(labels_of(s), value(s)); });
  };
  gauge("frames_pending", "Frames that wait or are in work.",
        [](const source_status_t& s) { return s.pending; });
  gauge("frame_rate_hertz", "Messages a second over the last second.",
        [](const source_status_t& s) { return s.rate; });
  gauge("newest_frame_age_seconds", "Time since the newest message; -1: none yet.",
        [](const source_status_t& s) { return s.age; });
  gauge("degraded", "Whether frames are worked on with coarser voxels.",
        [](const source_status_t& s) { return std::int32_t{s.degraded}; });
  write_each(m, status, "latency_seconds", "gauge", "Arrival to answer over the last 256 processed frames.",
             [&](const source_status_t& s) {
               m.sample(with(labels_of(s), "quantile", "0.5"), s.latency_p50);
               m.sample(with(labels_of(s), "quantile", "0.99"), s.latency_p99);
             });
}

}  // namespace

std::string prometheus_text(const status_t& status) {
  Metrics metrics;
  write_up(metrics, 1);
  write_process(metrics, status);
  write_losses(metrics, status);
  write_source_counters(metrics, status);
  write_source_gauges(metrics, status);
  return metrics.text();
}

std::string prometheus_down() {
  Metrics metrics;
  write_up(metrics, 0);
  return metrics.text();
}

}  // namespace graspd
