// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/status/status_text.hpp"

#include "client/common/json_writer.hpp"
#include "client/common/text.hpp"

namespace graspd {
namespace {

std::string count(std::int64_t value) {
  return printed("%lld", static_cast<long long>(value));
}

std::string_view state_name(std::int8_t state) {
  if (state == status_t::RUNNING) return "running";
  return state == status_t::STOPPING ? "stopping" : "unknown";
}

std::string uptime(double seconds) {
  const auto s = static_cast<long long>(seconds);
  return printed("%lld:%02lld:%02lld", s / 3600, s / 60 % 60, s % 60);
}

void write_source(JsonWriter& json, const source_status_t& source) {
  json.begin_object().member("name", source.name).member("channel", source.channel);
  json.member("received", source.received)
      .member("processed", source.processed)
      .member("dropped", source.dropped);
  json.member("refused", source.refused).member("pending", source.pending).member("lost", source.lost);
  json.member("rate", source.rate)
      .member("latency_p50", source.latency_p50)
      .member("latency_p99", source.latency_p99);
  json.key("refusals").begin_object();
  for (const reason_count_t& refusal : source.refusals) json.member(refusal.reason, refusal.count);
  json.end_object().member("last_error", source.last_error).end_object();
}

}  // namespace

std::string status_text(const status_t& status) {
  std::string text = "graspd " + plain_line(status.version) + " on " + plain_line(status.host) +
                     printed(" (pid %d) ", status.pid) + std::string(state_name(status.state)) + " for " +
                     uptime(status.uptime) +
                     printed(", cpu %.2f, memory %.0f MB (peak %.0f MB), %d workers", status.cpu,
                             1e-6 * static_cast<double>(status.rss),
                             1e-6 * static_cast<double>(status.peak_rss), status.num_workers);
  if (status.ignored > 0) text += ", " + count(status.ignored) + " messages ignored: too many sources";
  text += '\n';
  TextTable table({"source", "channel", "received", "processed", "dropped", "refused", "pending", "lost",
                   "Hz", "p50 [ms]", "p99 [ms]"});
  for (const source_status_t& s : status.sources) {
    table.add({plain_line(s.name), plain_line(s.channel), count(s.received), count(s.processed),
               count(s.dropped), count(s.refused), count(s.pending), count(s.lost), printed("%.1f", s.rate),
               printed("%.1f", 1e3 * s.latency_p50), printed("%.1f", 1e3 * s.latency_p99)});
  }
  text += status.sources.empty() ? "no clouds yet\n" : table.str();
  for (const source_status_t& s : status.sources) {
    if (!s.last_error.empty())
      text += plain_line(s.channel) + ": last refusal: " + plain_line(s.last_error) + '\n';
  }
  return text;
}

std::string status_json(const status_t& status) {
  JsonWriter json;
  json.begin_object()
      .member("utime", status.utime)
      .member("version", status.version)
      .member("host", status.host);
  json.member("pid", status.pid).member("state", state_name(status.state)).member("uptime", status.uptime);
  json.member("cpu", status.cpu).member("rss", status.rss).member("peak_rss", status.peak_rss);
  json.member("num_workers", status.num_workers).member("ignored", status.ignored);
  json.key("sources").begin_array();
  for (const source_status_t& source : status.sources) write_source(json, source);
  json.end_array().end_object();
  return json.str();
}

}  // namespace graspd
