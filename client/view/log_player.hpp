// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Plays event logs into a viewer: at a speed, step by step, from any place.
#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "client/view/commands.hpp"
#include "client/view/viewer.hpp"
#include "service/transport/seal.hpp"

namespace graspd {

/// Holds an index of the log's events of our types, and one message at a time. Belongs to one thread.
class LogPlayer {
 public:
  /// One log: its files in their order, and the keys that open what is signed. Throws EventLogError when they
  /// cannot be read or hold no cloud that can.
  LogPlayer(const std::vector<std::filesystem::path>& files, std::span<const SealKey> keys);

  void obey(const PlayerCommand& command, Viewer& viewer);
  /// Hands over what is due. To be called often; work that takes long makes the log run slower.
  void advance(std::chrono::steady_clock::time_point now, Viewer& viewer);

  /// The log's clock [us] since 1970.
  [[nodiscard]] std::int64_t now_us() const { return start_us_ + position_us_; }
  [[nodiscard]] std::size_t events() const { return events_.size(); }
  [[nodiscard]] bool has_segmentations() const { return segmentations_; }
  [[nodiscard]] bool playing() const { return playing_; }
  [[nodiscard]] std::int64_t position_us() const { return position_us_; }
  [[nodiscard]] std::int64_t length_us() const;
  /// {"type":"player", ...}
  [[nodiscard]] std::string json() const;

 private:
  enum class Kind : std::uint8_t { kIgnored, kCloud, kAnswer, kOther };
  struct Event {
    std::int64_t recv_utime = 0;
    std::int64_t position = 0;  // in its file [bytes]
    std::uint32_t file = 0;
    Kind kind = Kind::kIgnored;
  };

  void index(std::uint32_t file, std::span<const SealKey> keys);
  [[nodiscard]] Kind kind_of(std::span<const std::byte> message);
  void feed(Viewer& viewer);
  void step(Viewer& viewer);
  void seek(std::int64_t position_us, Viewer& viewer);

  std::vector<std::filesystem::path> files_;
  std::vector<Event> events_;  // by time
  bool answers_ = false;
  bool segmentations_ = false;
  bool unopened_ = false;
  std::size_t next_ = 0;
  std::int64_t start_us_ = 0;
  std::int64_t position_us_ = 0;  // from the start
  bool playing_ = true;
  double speed_ = 1;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace graspd
