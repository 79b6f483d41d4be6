// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/status_codec.hpp"

#include "service/transport/byte_reader.hpp"
#include "service/transport/encoding.hpp"
#include "service/transport/message_parts.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

constexpr std::int32_t kMaxSources = 10'000;
constexpr std::int32_t kMaxErrors = 1000;
constexpr std::size_t kMinSourceBytes = 3 * (4 + 1) + 8 * 8 + 4 * 8 + 1 + 2 * 4;
constexpr std::size_t kMinErrorBytes = 8 + 2 * (4 + 1) + 8;

void read(ByteReader& reader, source_status_t& source) {
  source.name = reader.string("sources.name", kMaxTextLength);
  source.channel = reader.string("sources.channel", kMaxTextLength);
  source.received = reader.int64("sources.received");
  source.processed = reader.int64("sources.processed");
  source.failed = reader.int64("sources.failed");
  source.coarse = reader.int64("sources.coarse");
  source.dropped = reader.int64("sources.dropped");
  source.refused = reader.int64("sources.refused");
  source.pending = reader.int64("sources.pending");
  source.lost = reader.int64("sources.lost");
  source.rate = reader.float64("sources.rate");
  source.age = reader.float64("sources.age");
  source.latency_p50 = reader.float64("sources.latency_p50");
  source.latency_p99 = reader.float64("sources.latency_p99");
  source.degraded = reader.int8("sources.degraded");
  source.num_drops = read_reason_counts(reader, source.drops);
  source.num_refusals = read_reason_counts(reader, source.refusals);
  source.last_error = reader.string("sources.last_error", kMaxTextLength);
}

void read(ByteReader& reader, error_report_t& error) {
  error.utime = reader.int64("errors.utime");
  error.event = reader.string("errors.event", kMaxTextLength);
  error.text = reader.string("errors.text", kMaxTextLength);
  error.count = reader.int64("errors.count");
}

void read_process(ByteReader& reader, status_t& status) {
  status.utime = reader.int64("utime");
  status.version = reader.string("version", kMaxTextLength);
  status.host = reader.string("host", kMaxTextLength);
  status.pid = reader.int32("pid");
  status.state = reader.int8("state");
  status.uptime = reader.float64("uptime");
  status.cpu = reader.float64("cpu");
  status.rss = reader.int64("rss");
  status.peak_rss = reader.int64("peak_rss");
  status.num_threads = reader.int32("num_threads");
  status.num_descriptors = reader.int32("num_descriptors");
}

void read_service(ByteReader& reader, status_t& status) {
  status.num_workers = reader.int32("num_workers");
  status.num_stuck = reader.int32("num_stuck");
  status.waiting_bytes = reader.int64("waiting_bytes");
  status.receive_errors = reader.int64("receive_errors");
  status.reassembly_errors = reader.int64("reassembly_errors");
  status.reconnects = reader.int64("reconnects");
  status.log_lost = reader.int64("log_lost");
  status.ignored = reader.int64("ignored");
  status.config_revision = reader.int64("config_revision");
  status.config_error = reader.string("config_error", kMaxTextLength);
  status.control_id = reader.int64("control_id");
  status.overrides = reader.string("overrides", kMaxOverridesLength);
}

}  // namespace

void encode(const status_t& status, std::vector<std::byte>& buffer) {
  require_count("status_t.num_errors", status.num_errors, status.errors.size());
  require_count("status_t.num_sources", status.num_sources, status.sources.size());
  for (const source_status_t& source : status.sources) {
    require_count("source_status_t.num_drops", source.num_drops, source.drops.size());
    require_count("source_status_t.num_refusals", source.num_refusals, source.refusals.size());
  }
  encode_message(status, buffer);
}

std::vector<std::byte> encode(const status_t& status) {
  return encoded(status);
}

std::optional<status_t> decode_status(std::span<const std::byte> message) {
  if (fingerprint(message) != kStatusFingerprint) return std::nullopt;
  ByteReader reader(message.subspan(kFingerprintBytes));
  status_t status;
  read_process(reader, status);
  read_service(reader, status);
  status.num_errors = reader.count("num_errors", kMaxErrors, kMinErrorBytes);
  status.errors.resize(static_cast<std::size_t>(status.num_errors));
  for (error_report_t& error : status.errors) read(reader, error);
  status.num_sources = reader.count("num_sources", kMaxSources, kMinSourceBytes);
  status.sources.resize(static_cast<std::size_t>(status.num_sources));
  for (source_status_t& source : status.sources) read(reader, source);
  reader.finish();
  if (!reader.ok()) return std::nullopt;
  return status;
}

}  // namespace graspd
