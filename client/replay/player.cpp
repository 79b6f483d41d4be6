// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/player.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "client/common/text.hpp"

namespace graspd {
namespace {

constexpr double kSlowest = 0.01, kFastest = 1000;

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  return whole && value > -1e9 && value < 1e9 ? std::optional(value) : std::nullopt;
}

}  // namespace

Player::Player(std::vector<LogPart> parts, const std::string& channels, double speed, TimePoint now,
               bool scan)
    : parts_(std::move(parts)),
      channels_(channels),
      scan_(scan),
      search_(parts_),
      archive_(parts_),
      speed_(speed),
      base_time_(now) {
  EventHead head;
  if (archive_.next_head(head)) first_utime_ = head.recv_utime;
  archive_ = Archive(parts_);
  advance();
}

void Player::advance() {
  EventHead head;
  while (archive_.next_head(head)) {
    if (!std::regex_match(head.channel, channels_)) continue;
    pending_ = std::move(head);
    return;
  }
  pending_.reset();
}

double Player::position_s(TimePoint now) const {
  if (paused_) return base_s_;
  return base_s_ + speed_ * std::chrono::duration<double>(now - base_time_).count();
}

std::optional<Player::TimePoint> Player::due() const {
  if (paused_ || !pending_) return std::nullopt;
  const double at_s = 1e-6 * static_cast<double>(pending_->recv_utime - first_utime_);
  const std::chrono::duration<double> wait((at_s - base_s_) / speed_);
  return base_time_ + std::chrono::duration_cast<TimePoint::duration>(wait);
}

LoggedEvent Player::take() {
  LoggedEvent event{pending_->recv_utime, std::move(pending_->channel), {}};
  archive_.read_message(event.bytes);
  advance();
  return event;
}

void Player::rebase(TimePoint now) {
  base_s_ = position_s(now);
  base_time_ = now;
}

void Player::seek(double position_s, TimePoint now) {
  rebase(now);
  base_s_ = std::max(0.0, position_s);
  const auto utime = first_utime_ + static_cast<std::int64_t>(1e6 * base_s_);
  archive_ = Archive(scan_ ? parts_ : search_.rest(utime));
  do advance();
  while (pending_ && pending_->recv_utime < utime);
}

bool Player::obey(std::string_view command, TimePoint now) {
  const std::string_view word = next_word(command);
  const auto value = number(next_word(command));
  if (word == "pause" || word == "play" || word == "toggle") {
    rebase(now);
    paused_ = word == "pause" || (word == "toggle" && !paused_);
  } else if (word == "seek" && value) {
    seek(*value, now);
  } else if (word == "skip" && value) {
    seek(position_s(now) + *value, now);
  } else if (word == "speed" && value && *value > 0) {
    rebase(now);
    speed_ = std::clamp(*value, kSlowest, kFastest);
  } else {
    return false;
  }
  return true;
}

}  // namespace graspd
