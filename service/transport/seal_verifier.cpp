// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/seal_verifier.hpp"

#include <algorithm>
#include <string>

namespace graspd {
namespace {

constexpr std::uint64_t kWindow = 64;

/// Notes a sequence number; false when it has come before, or may have.
bool note(std::int64_t seq, std::int64_t& newest, std::uint64_t& seen) {
  // The difference of any two numbers fits without a sign.
  if (seq > newest) {
    const std::uint64_t step = static_cast<std::uint64_t>(seq) - static_cast<std::uint64_t>(newest);
    seen = step < kWindow ? (seen << step) | 1u : 1u;
    newest = seq;
    return true;
  }
  const std::uint64_t back = static_cast<std::uint64_t>(newest) - static_cast<std::uint64_t>(seq);
  if (back >= kWindow || ((seen >> back) & 1u) != 0) return false;
  seen |= std::uint64_t{1} << back;
  return true;
}

Refusal refuse(RefusalReason reason, const std::string& text) {
  return {reason, "sealed_t." + text, 0, -1, {}};
}

}  // namespace

SealVerifier::SealVerifier(std::vector<SealKey> keys, std::int64_t max_age_us) {
  configure(std::move(keys), max_age_us);
}

void SealVerifier::configure(std::vector<SealKey> keys, std::int64_t max_age_us) {
  keys_ = std::move(keys);
  max_age_us_ = max_age_us;
}

std::variant<std::span<const std::byte>, Refusal> SealVerifier::open(std::string_view channel,
                                                                     std::span<const std::byte> sealed,
                                                                     std::int64_t now_utime) {
  const auto unsealed = unseal(keys_, channel, sealed);
  if (const auto* refusal = std::get_if<Refusal>(&unsealed)) return *refusal;
  const auto& [header, message] = std::get<Unsealed>(unsealed);
  if (header.utime < now_utime - max_age_us_ || header.utime > now_utime + max_age_us_)
    return refuse(RefusalReason::kStale, "utime: not of now (got " + std::to_string(header.utime) +
                                             ", expected " + std::to_string(now_utime) + " +- " +
                                             std::to_string(max_age_us_) + ")");
  Sender* sender = find_or_add(header);
  if (sender == nullptr)
    return refuse(RefusalReason::kStale, "utime: older than what forgotten senders have sent");
  if (!note(header.seq, sender->newest_seq, sender->seen))
    return refuse(RefusalReason::kReplayed, "seq: has come before (got " + std::to_string(header.seq) +
                                                ", the newest is " + std::to_string(sender->newest_seq) +
                                                ")");
  sender->newest_utime = std::max(sender->newest_utime, header.utime);
  return message;
}

/// Null for a sender that may be one of those forgotten.
SealVerifier::Sender* SealVerifier::find_or_add(const SealHeader& header) {
  if (const auto found = senders_.find(header.sender); found != senders_.end()) return &found->second;
  if (header.utime <= forgotten_utime_) return nullptr;
  if (senders_.size() >= kMaxSenders) forget_oldest();
  // Nothing of it has come yet: its first number is noted like one that was overtaken.
  return &senders_.emplace(header.sender, Sender{header.seq, 0, header.utime}).first->second;
}

void SealVerifier::forget_oldest() {
  const auto oldest = std::min_element(senders_.begin(), senders_.end(), [](const auto& a, const auto& b) {
    return a.second.newest_utime < b.second.newest_utime;
  });
  forgotten_utime_ = std::max(forgotten_utime_, oldest->second.newest_utime);
  senders_.erase(oldest);
}

}  // namespace graspd
