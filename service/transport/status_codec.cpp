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
constexpr std::size_t kMinSourceBytes = 3 * (4 + 1) + 6 * 8 + 3 * 8 + 4;

void read(ByteReader& reader, source_status_t& source) {
  source.name = reader.string("sources.name", kMaxTextLength);
  source.channel = reader.string("sources.channel", kMaxTextLength);
  source.received = reader.int64("sources.received");
  source.processed = reader.int64("sources.processed");
  source.dropped = reader.int64("sources.dropped");
  source.refused = reader.int64("sources.refused");
  source.pending = reader.int64("sources.pending");
  source.lost = reader.int64("sources.lost");
  source.rate = reader.float64("sources.rate");
  source.latency_p50 = reader.float64("sources.latency_p50");
  source.latency_p99 = reader.float64("sources.latency_p99");
  source.num_refusals = read_reason_counts(reader, source.refusals);
  source.last_error = reader.string("sources.last_error", kMaxTextLength);
}

}  // namespace

void encode(const status_t& status, std::vector<std::byte>& buffer) {
  require_count("status_t.num_sources", status.num_sources, status.sources.size());
  for (const source_status_t& source : status.sources) {
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
  status.utime = reader.int64("utime");
  status.version = reader.string("version", kMaxTextLength);
  status.host = reader.string("host", kMaxTextLength);
  status.pid = reader.int32("pid");
  status.state = reader.int8("state");
  status.uptime = reader.float64("uptime");
  status.cpu = reader.float64("cpu");
  status.rss = reader.int64("rss");
  status.peak_rss = reader.int64("peak_rss");
  status.num_workers = reader.int32("num_workers");
  status.ignored = reader.int64("ignored");
  status.num_sources = reader.count("num_sources", kMaxSources, kMinSourceBytes);
  status.sources.resize(static_cast<std::size_t>(status.num_sources));
  for (source_status_t& source : status.sources) read(reader, source);
  reader.finish();
  if (!reader.ok()) return std::nullopt;
  return status;
}

}  // namespace graspd
