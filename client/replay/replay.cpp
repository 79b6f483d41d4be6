// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/replay.hpp"

#include <atomic>
#include <utility>

#include "client/common/handle_text.hpp"
#include "client/common/sealed_message.hpp"
#include "client/common/sha256.hpp"
#include "client/common/stop_flag.hpp"
#include "client/replay/effective_config.hpp"
#include "service/transport/cloud_decoder.hpp"
#include "service/transport/handle_list_codec.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

// Messages that are in memory at a time [bytes], or one that is larger.
constexpr std::int64_t kMostWaitingBytes = 64 << 20;
constexpr std::size_t kItemsAThread = 4;

}  // namespace

std::string identity_of(const ReplayConfig& config) {
  const Selection& s = config.selection;
  std::string text = "graspd " GRASPD_VERSION " replay 1\n" + effective_config(config.service) + "\nkeep " +
                     config.keep + "\ntimes " + (config.times ? "1" : "0") + "\nselection";
  for (const std::int64_t bound : {s.from_utime, s.to_utime, s.first_frame, s.end_frame})
    text += ' ' + std::to_string(bound);
  for (const LogPart& part : config.parts) {
    text += "\nlog " + part.path.string() + ' ' + std::to_string(std::filesystem::file_size(part.path)) +
            ' ' + std::to_string(part.part.begin) + ' ' + std::to_string(part.part.end);
  }
  return sha256_of(text);
}

Replay::Replay(ReplayConfig config, ReplayOutput& output)
    : config_(std::move(config)),
      output_(output),
      channels_(config_.service, config_.keep, clock_),
      state_(output.start()),
      archive_(config_.reading.empty() ? config_.parts : config_.reading, state_.input),
      threads_(config_.threads) {
  const bool fresh = state_.input.part == 0 && state_.input.offset < 0;
  if (fresh) state_.frames_seen = config_.frames_before;
  frames_read_ = state_.frames_seen;
  keys_ = seal_keys_of(config_.service.authentication.key_file);
}

bool Replay::run(const OnProgress& on_progress) {
  next_checkpoint_ = clock_.now();
  while (!stop_requested()) {
    const std::size_t most = kItemsAThread * static_cast<std::size_t>(config_.threads);
    while (!ended_ && items_.size() < most && (items_.empty() || waiting_bytes_ < kMostWaitingBytes))
      ended_ = !take_next();
    if (items_.empty()) break;
    commit(items_.front());
    on_progress({state_, items_.front().bytes_done, archive_.bytes_in_all()});
    waiting_bytes_ -= items_.front().head.size;
    items_.pop_front();
    checkpoint_when_due();
  }
  if (ended_ && items_.empty()) {
    state_.input = archive_.position();
    state_.frames_seen = frames_read_;
    return true;
  }
  output_.checkpoint(state_);
  return false;
}

bool Replay::take_next() {
  const Selection& selection = config_.selection;
  EventHead head;
  while (frames_read_ < selection.end_frame && archive_.next_head(head)) {
    const ChannelUse& use = channels_.find(head.channel);
    const std::int64_t frame = frames_read_;
    if (use.processor) ++frames_read_;
    const bool chosen = selection.has_time(head.recv_utime) && selection.has_frame(frame);
    if (!chosen || (!use.processor && !use.keep)) continue;
    Item& item = items_.emplace_back();
    archive_.read_message(item.message.bytes);
    item.message.header = peek_header(item.message.bytes, config_.service.limits.decode);
    item.after = archive_.position();
    item.bytes_done = archive_.bytes_done();
    item.frames_seen = frames_read_;
    item.use = &use;
    item.head = std::move(head);
    waiting_bytes_ += item.head.size;
    if (use.processor && keys_.empty() && fingerprint(item.message.bytes) == kSealedFingerprint) ++unopened_;
    if (use.processor) item.answer = threads_.start([this, &item] { return answer(item); });
    return true;
  }
  return false;
}

EncodedAnswer Replay::answer(const Item& item) const {
  const FrameProcessor& processor = *item.use->processor;
  const std::atomic<bool> never{false};
  FrameMessage opened;
  const FrameMessage* message = &item.message;
  EncodedAnswer result;
  const auto arrival = clock_.now();
  std::optional<Refusal> refusal;
  if (!keys_.empty()) {
    // The seal's time and order were the live daemon's to check: the past may be looked at again.
    auto inside = unseal(keys_, item.head.channel, item.message.bytes);
    if (const auto* refused = std::get_if<Refusal>(&inside)) {
      refusal = *refused;
    } else {
      const auto bytes = std::get<Unsealed>(inside).message;
      opened.bytes.assign(bytes.begin(), bytes.end());
      opened.header = peek_header(bytes, config_.service.limits.decode);
      message = &opened;
    }
  }
  if (!refusal) refusal = processor.check(message->bytes);
  const Answer answer =
      refusal ? processor.refuse(*refusal, arrival) : processor.process(*message, Effort::kFull, never);
  result.handles_channel = answer.handles_channel;
  handle_list_t& list = result.list = decode_handle_list(answer.list.bytes).value();
  list.latency = config_.times ? seconds(clock_.now() - arrival) : 0;
  if (!config_.times)
    for (stage_time_t& stage : list.stages) stage.milliseconds = 0;
  result.message = encode(list);
  return result;
}

void Replay::commit(Item& item) {
  if (item.use->keep) {
    output_.write(item.head.recv_utime, item.head.channel, item.message.bytes);
    ++state_.kept;
  }
  if (item.answer.valid()) {
    const EncodedAnswer done = item.answer.get();
    output_.write(item.head.recv_utime, done.handles_channel, done.message);
    ++state_.frames;
    state_.handles += done.list.num_handles;
    ++state_.answers[std::string(status_name(done.list.status))];
  }
  state_.input = item.after;
  state_.frames_seen = item.frames_seen;
}

void Replay::checkpoint_when_due() {
  const Clock::TimePoint now = clock_.now();
  if (now < next_checkpoint_) return;
  output_.checkpoint(state_);
  next_checkpoint_ = now + std::chrono::duration_cast<Clock::TimePoint::duration>(
                               std::chrono::duration<double>(config_.checkpoint_s));
}

}  // namespace graspd
