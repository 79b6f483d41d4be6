// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/merge.hpp"

#include <stdexcept>

#include "client/common/sha256.hpp"
#include "client/common/text.hpp"
#include "service/transport/handle_list_codec.hpp"

namespace graspd {
namespace {

[[noreturn]] void fail(std::size_t shard, const std::string& what) {
  throw std::runtime_error(printed("shard %zu: %s", shard, what.c_str()));
}

Receipt checked_receipt(const std::filesystem::path& folder, const Plan& plan, std::size_t shard) {
  const std::filesystem::path log = shard_log(folder, shard);
  const auto receipt = load_receipt(log.string() + ".receipt");
  if (!receipt || !std::filesystem::exists(log)) fail(shard, "not done");
  if (receipt->identity != identity_of(shard_config(folder, plan, shard)))
    fail(shard, "made with another configuration or version");
  if (receipt->state.frames != plan.shards[shard].frames)
    fail(shard, printed("%lld frames, %lld were planned", static_cast<long long>(receipt->state.frames),
                        static_cast<long long>(plan.shards[shard].frames)));
  if (sha256_of_file(log) != receipt->sha256) fail(shard, "not the bytes that were written");
  return *receipt;
}

void add(ReplayState& sum, const ReplayState& shard) {
  sum.input.skipped += shard.input.skipped;
  sum.frames_seen += shard.frames_seen;
  sum.frames += shard.frames;
  sum.kept += shard.kept;
  sum.handles += shard.handles;
  for (const auto& [status, count] : shard.answers) sum.answers[status] += count;
}

void copy_events(const std::filesystem::path& log, std::size_t shard, std::int64_t events,
                 ReplayOutput& output) {
  EventLogReader reader(log);
  LoggedEvent event;
  std::int64_t count = 0;
  for (; reader.next(event); ++count) output.write(event.recv_utime, event.channel, event.bytes);
  if (count != events || reader.skipped_bytes() != 0) fail(shard, "its log is not whole");
}

}  // namespace

std::vector<std::size_t> missing_shards(const std::filesystem::path& folder, const Plan& plan) {
  std::vector<std::size_t> missing;
  ReplayConfig config = shard_config(folder, plan, 0);
  for (std::size_t i = 0; i < plan.shards.size(); ++i) {
    const std::filesystem::path log = shard_log(folder, i);
    const auto receipt = load_receipt(log.string() + ".receipt");
    config.parts = plan.shards[i].parts;
    std::error_code error;
    const auto size = static_cast<std::int64_t>(std::filesystem::file_size(log, error));
    if (!receipt || error || size != receipt->state.output_bytes || receipt->identity != identity_of(config))
      missing.push_back(i);
  }
  return missing;
}

Receipt merge_shards(const std::filesystem::path& folder, const Plan& plan, const std::filesystem::path& file,
                     OldOutput old) {
  ReplayState sum;
  std::vector<std::int64_t> events;
  std::string identity = "merged";
  for (std::size_t i = 0; i < plan.shards.size(); ++i) {
    const Receipt receipt = checked_receipt(folder, plan, i);
    add(sum, receipt.state);
    events.push_back(receipt.state.output_events);
    identity += ' ' + receipt.identity;
  }
  if (sum.frames != plan.frames) throw std::runtime_error("the shards have not all frames of the plan");
  ReplayOutput output(file, sha256_of(identity), old);
  for (std::size_t i = 0; i < plan.shards.size(); ++i)
    copy_events(shard_log(folder, i), i, events[i], output);
  return output.finish(sum);
}

}  // namespace graspd
