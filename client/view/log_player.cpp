// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/view/log_player.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "client/common/json_writer.hpp"
#include "client/common/sealed_message.hpp"
#include "client/log/event_log_reader.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

constexpr std::int64_t kLongWait_us =
    10'000'000;  // by which everything that waits in a matcher waits in vain

}  // namespace

LogPlayer::LogPlayer(const std::vector<std::filesystem::path>& files, std::span<const SealKey> keys)
    : files_(files) {
  for (std::uint32_t i = 0; i < files_.size(); ++i) index(i, keys);
  const bool clouds =
      std::any_of(events_.begin(), events_.end(), [](const Event& e) { return e.kind == Kind::kCloud; });
  if (!clouds)
    throw EventLogError((files_.empty() ? "" : files_[0].string()) + ": no clouds are in this log" +
                        (unopened_ ? ", but signed messages: --key FILE opens them with the right key" : ""));
  std::stable_sort(events_.begin(), events_.end(),
                   [](const Event& a, const Event& b) { return a.recv_utime < b.recv_utime; });
  start_us_ = events_.front().recv_utime;
}

/// Of a channel's first message; what follows on it is taken for the same.
LogPlayer::Kind LogPlayer::kind_of(std::span<const std::byte> message) {
  const std::optional<std::uint64_t> type = fingerprint(message);
  if (type == kPointCloudFingerprint || type == kDepthImageFingerprint) return Kind::kCloud;
  unopened_ = unopened_ || type == kSealedFingerprint;
  answers_ = answers_ || type == kHandleListFingerprint;
  segmentations_ = segmentations_ || type == kSegmentationFingerprint;
  if (type == kHandleListFingerprint) return Kind::kAnswer;
  const bool ours = type == kSegmentationFingerprint || type == kStatusFingerprint;
  return ours ? Kind::kOther : Kind::kIgnored;
}

void LogPlayer::index(std::uint32_t file, std::span<const SealKey> keys) {
  EventLogReader reader(files_[file]);
  std::map<std::string, Kind> kinds;
  EventHead head;
  std::vector<std::byte> message;
  while (reader.next_head(head)) {
    auto known = kinds.find(head.channel);
    if (known == kinds.end()) {
      reader.read_message(message);
      const auto inside = opened(keys, head.channel, message);
      // What a stranger has signed says nothing of the channel.
      if (!keys.empty() && fingerprint(inside) == kSealedFingerprint) {
        unopened_ = true;
        continue;
      }
      known = kinds.emplace(head.channel, kind_of(inside)).first;
    }
    if (known->second != Kind::kIgnored)
      events_.push_back({head.recv_utime, head.position, file, known->second});
  }
}

std::int64_t LogPlayer::length_us() const {
  return events_.back().recv_utime - start_us_;
}

/// The next event, and the clock with it.
void LogPlayer::feed(Viewer& viewer) {
  const Event& event = events_[next_++];
  position_us_ = std::max(position_us_, event.recv_utime - start_us_);
  EventLogReader reader(files_[event.file], {event.position, event.position + 1});
  LoggedEvent logged;
  if (reader.next(logged)) viewer.take(logged.channel, logged.bytes, event.recv_utime);
}

void LogPlayer::advance(std::chrono::steady_clock::time_point now, Viewer& viewer) {
  const double passed_us = std::chrono::duration<double, std::micro>(now - std::exchange(last_, now)).count();
  constexpr double kLongest_us = 500'000;  // of a program that was stopped
  if (!playing_ || passed_us > kLongest_us) return;
  const std::int64_t due_us = position_us_ + static_cast<std::int64_t>(passed_us * speed_);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
  while (next_ < events_.size() && events_[next_].recv_utime - start_us_ <= due_us) {
    feed(viewer);
    if (std::chrono::steady_clock::now() > deadline) return;  // the clock stays at what was handed over
  }
  position_us_ = std::min(due_us, length_us());
  if (next_ < events_.size()) return;
  playing_ = false;
  viewer.look(now_us() + kLongWait_us);
}

void LogPlayer::step(Viewer& viewer) {
  playing_ = false;
  const std::int64_t shown = viewer.pages().frames();
  while (next_ < events_.size() && viewer.pages().frames() == shown) {
    const bool cloud = events_[next_].kind == Kind::kCloud;
    feed(viewer);
    if (cloud && !answers_) viewer.look(now_us() + kLongWait_us);
  }
  if (viewer.pages().frames() == shown) viewer.look(now_us() + kLongWait_us);
}

/// Shows the last frame that was answered by then.
void LogPlayer::seek(std::int64_t position_us, Viewer& viewer) {
  viewer.clear();
  const std::int64_t wanted = start_us_ + std::clamp<std::int64_t>(position_us, 0, length_us());
  const auto end = std::upper_bound(events_.begin(), events_.end(), wanted,
                                    [](std::int64_t time, const Event& e) { return time < e.recv_utime; });
  auto begin = end;
  // Back to the last answer, and to the clouds before it that it may belong to.
  const Kind last = answers_ ? Kind::kAnswer : Kind::kCloud;
  while (begin != events_.begin() && (begin == end || begin->kind != last)) --begin;
  for (int clouds = 0; begin != events_.begin() && clouds < 4;)
    clouds += (--begin)->kind == Kind::kCloud ? 1 : 0;
  next_ = static_cast<std::size_t>(begin - events_.begin());
  position_us_ = events_[next_].recv_utime - start_us_;
  const auto stop = static_cast<std::size_t>(end - events_.begin());
  while (next_ < stop) feed(viewer);
  viewer.look(now_us() + kLongWait_us);
  position_us_ = wanted - start_us_;
}

void LogPlayer::obey(const PlayerCommand& command, Viewer& viewer) {
  if (command.speed) speed_ = *command.speed;
  if (command.seek_us) seek(*command.seek_us, viewer);
  if (command.playing) {
    if (*command.playing && next_ >= events_.size()) seek(0, viewer);  // from the start again
    playing_ = *command.playing;
  }
  if (command.step) step(viewer);
}

std::string LogPlayer::json() const {
  JsonWriter json;
  json.begin_object().member("type", "player").member("playing", std::int64_t{playing_ ? 1 : 0});
  json.member("speed", speed_).member("position_us", position_us_).member("length_us", length_us());
  return json.member("start_utime", start_us_).end_object().str();
}

}  // namespace graspd
