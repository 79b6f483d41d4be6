// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// From messages to pages: takes what comes over LCM or out of a log, and what pages ask for.
#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "client/view/control_channel.hpp"
#include "client/view/frame_matcher.hpp"
#include "client/view/page_server.hpp"
#include "client/view/settings.hpp"
#include "service/transport/seal_verifier.hpp"

namespace graspd {

struct ViewerOptions {
  WebConfig web;
  FrameMessageOptions frames;
  std::string config_file;
  std::string key_file;
  std::string log_file;  ///< empty: live
};

/// Belongs to one thread.
class Viewer {
 public:
  using OnPlayer = std::function<void(const PlayerCommand&)>;

  explicit Viewer(const ViewerOptions& options);

  /// Pages may change settings from now on.
  void use_control(ControlChannel& control, bool daemon_listens);
  void on_player(OnPlayer player) { player_ = std::move(player); }

  [[nodiscard]] const Settings& settings() const { return settings_; }
  [[nodiscard]] PageServer& pages() { return pages_; }

  /// A message, told by its fingerprint; others are ignored. now_us: of the clock that look() goes by.
  void take(const std::string& channel, std::span<const std::byte> message, std::int64_t now_us);
  /// To be called often.
  void look(std::int64_t now_us);
  /// The log has segmentations.
  void expect_segmentations() { matcher_.expect_segmentations(); }
  /// A log's clock has jumped.
  void clear();
  /// What a log's player does, as JSON.
  void show_player(const std::string& json);

 private:
  void take_opened(const std::string& channel, std::span<const std::byte> message, std::int64_t now_us);
  void take_status(std::span<const std::byte> message);
  void execute(const WebClient& client, const Command& command);
  void change_settings(const WebClient& client, std::int8_t command, const std::string& yaml);
  void show_settings();
  void ask_for_segments();

  const ViewerOptions options_;
  Settings settings_;
  SealVerifier verifier_;
  ControlChannel* control_ = nullptr;
  bool daemon_listens_ = false;
  OnPlayer player_;
  PageServer pages_;
  FrameMatcher matcher_;
  std::chrono::steady_clock::time_point next_second_;
};

}  // namespace graspd
