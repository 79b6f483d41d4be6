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
  switch (state) {
    case status_t::RUNNING:
      return "running";
    case status_t::STOPPING:
      return "stopping";
    case status_t::STUCK:
      return "stuck";
    default:
      return "unknown";
  }
}

std::string uptime(double seconds) {
  const auto s = static_cast<long long>(seconds);
  return printed("%lld:%02lld:%02lld", s / 3600, s / 60 % 60, s % 60);
}

void write_counts(JsonWriter& json, std::string_view name, const std::vector<reason_count_t>& counts) {
  json.key(name).begin_object();
  for (const reason_count_t& entry : counts) json.member(entry.reason, entry.count);
  json.end_object();
}

void write_errors(JsonWriter& json, const status_t& status) {
  json.key("errors").begin_array();
  for (const error_report_t& error : status.errors) {
    json.begin_object().member("utime", error.utime).member("event", error.event);
    json.member("text", error.text).member("count", error.count).end_object();
  }
  json.end_array();
}

std::string reasons(const std::vector<reason_count_t>& counts) {
  std::string text;
  for (const reason_count_t& entry : counts)
    text += (text.empty() ? "" : ", ") + plain_line(entry.reason) + " " + count(entry.count);
  return text;
}

/// What is not as it should be, one line each.
std::string troubles(const status_t& status) {
  std::string text;
  if (status.num_stuck > 0) text += printed("%d frames are stuck\n", status.num_stuck);
  if (status.ignored > 0) text += count(status.ignored) + " messages ignored: too many sources\n";
  if (status.receive_errors > 0)
    text += count(status.receive_errors) + " datagrams lost: a receive buffer was full (net.core.rmem_max)\n";
  if (status.reassembly_errors > 0)
    text +=
        count(status.reassembly_errors) + " datagrams lost: pieces missing (net.ipv4.ipfrag_high_thresh)\n";
  if (status.reconnects > 0) text += "bus made anew " + count(status.reconnects) + " times\n";
  if (status.log_lost > 0) text += count(status.log_lost) + " lines of the log lost\n";
  if (!status.config_error.empty())
    text += "configuration not taken: " + plain_line(status.config_error) + '\n';
  return text;
}

std::string source_notes(const source_status_t& s) {
  std::string text;
  if (s.degraded != 0) text += plain_line(s.channel) + ": degraded, " + count(s.coarse) + " frames so far\n";
  if (!s.drops.empty()) text += plain_line(s.channel) + ": dropped: " + reasons(s.drops) + '\n';
  if (!s.refusals.empty()) text += plain_line(s.channel) + ": refused: " + reasons(s.refusals) + '\n';
  if (!s.last_error.empty())
    text += plain_line(s.channel) + ": last error: " + plain_line(s.last_error) + '\n';
  return text;
}

void write_source(JsonWriter& json, const source_status_t& source) {
  json.begin_object().member("name", source.name).member("channel", source.channel);
  json.member("received", source.received)
      .member("processed", source.processed)
      .member("failed", source.failed)
      .member("coarse", source.coarse)
      .member("dropped", source.dropped);
  json.member("refused", source.refused).member("pending", source.pending).member("lost", source.lost);
  json.member("rate", source.rate)
      .member("age", source.age)
      .member("latency_p50", source.latency_p50)
      .member("latency_p99", source.latency_p99);
  json.member("degraded", source.degraded);
  write_counts(json, "drops", source.drops);
  write_counts(json, "refusals", source.refusals);
  json.member("last_error", source.last_error).end_object();
}

}  // namespace

std::string status_text(const status_t& status) {
  std::string text =
      "graspd " + plain_line(status.version) + " on " + plain_line(status.host) +
      printed(" (pid %d) ", status.pid) + std::string(state_name(status.state)) + " for " +
      uptime(status.uptime) +
      printed(
          ", cpu %.2f, memory %.0f MB (peak %.0f MB), %d threads, %d files, %d workers, configuration %lld",
          status.cpu, 1e-6 * static_cast<double>(status.rss), 1e-6 * static_cast<double>(status.peak_rss),
          status.num_threads, status.num_descriptors, status.num_workers,
          static_cast<long long>(status.config_revision));
  text += '\n' + troubles(status);
  TextTable table({"source", "channel", "received", "processed", "dropped", "refused", "pending", "lost",
                   "Hz", "p50 [ms]", "p99 [ms]"});
  for (const source_status_t& s : status.sources) {
    table.add({plain_line(s.name), plain_line(s.channel), count(s.received), count(s.processed),
               count(s.dropped), count(s.refused), count(s.pending), count(s.lost), printed("%.1f", s.rate),
               printed("%.1f", 1e3 * s.latency_p50), printed("%.1f", 1e3 * s.latency_p99)});
  }
  text += status.sources.empty() ? "no clouds yet\n" : table.str();
  for (const source_status_t& s : status.sources) text += source_notes(s);
  for (const error_report_t& error : status.errors)
    text += count(error.count) + " times: " + plain_line(error.text) + '\n';
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
  json.member("num_threads", status.num_threads).member("num_descriptors", status.num_descriptors);
  json.member("num_workers", status.num_workers).member("num_stuck", status.num_stuck);
  json.member("waiting_bytes", status.waiting_bytes).member("receive_errors", status.receive_errors);
  json.member("reassembly_errors", status.reassembly_errors).member("reconnects", status.reconnects);
  json.member("log_lost", status.log_lost).member("ignored", status.ignored);
  json.member("config_revision", status.config_revision).member("config_error", status.config_error);
  json.member("control_id", status.control_id).member("overrides", status.overrides);
  write_errors(json, status);
  json.key("sources").begin_array();
  for (const source_status_t& source : status.sources) write_source(json, source);
  json.end_array().end_object();
  return json.str();
}

}  // namespace graspd
