// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The pages that are open, and what each of them is shown.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "client/view/frame_matcher.hpp"
#include "client/view/frame_message.hpp"
#include "client/view/page_events.hpp"
#include "client/view/settings.hpp"
#include "client/web/web_server.hpp"

namespace graspd {

/// Belongs to one thread. A frame is made ready for pages only when one of them takes it; a page that has not
/// drawn the last two gets none until it has, and then the newest.
class PageServer {
 public:
  /// What goes beyond the pages: settings and the log's player. They may answer with refuse().
  using OnCommand = std::function<void(const WebClient&, const Command&)>;

  /// hello: the first message to every page, a JSON object without its closing brace.
  PageServer(WebConfig web, FrameMessageOptions options, std::string hello, const Settings& settings,
             OnCommand on_command);

  void start() { web_.start(); }
  [[nodiscard]] WebServer& web() { return web_; }
  /// That were shown since the start.
  [[nodiscard]] std::int64_t frames() const { return serial_; }
  [[nodiscard]] std::int64_t pages() const { return static_cast<std::int64_t>(pages_.size()); }

  void show(MatchedFrame frame);
  /// JSON that pages keep the newest of, and that pages which open later get, too.
  void show_state(int topic, const std::string& json);
  void tell(const WebClient& client, const std::string& json);
  void refuse(const WebClient& client, const std::string& why);

  /// What pages have done since the last call.
  void process();
  /// Forgets all frames: the log's clock has jumped.
  void clear();

  /// {"type":"server", ...}: clients, frames and counters.
  [[nodiscard]] std::string statistics() const;

 private:
  struct Page {
    WebClient client;
    std::string channel;  // empty: the first one
    bool paused = false;
    bool step = false;
    std::int64_t sent = 0;                // serial of the newest frame that went out
    std::vector<std::int64_t> not_drawn;  // of the frames that are on their way
  };
  struct Latest {
    MatchedFrame frame;
    std::int64_t serial = 0;
    WebMessage message;  // made when the first page takes it
  };

  [[nodiscard]] WebHandlers handlers();
  void received(const WebClient& client, std::string_view text, bool is_text);
  void opened(const WebClient& client);
  void execute(Page& page, const Command& command);
  void deliver(Page& page);
  [[nodiscard]] const WebMessage& message(Latest& latest);
  [[nodiscard]] std::string channels_json() const;

  const FrameMessageOptions options_;
  const std::string hello_;
  const Settings& settings_;
  const OnCommand on_command_;
  PageEvents events_;
  std::map<std::int64_t, Page> pages_;
  std::map<std::string, Latest> frames_;  // by channel
  std::vector<std::string> channels_;     // in the order of their first frames
  std::map<int, std::string> states_;
  std::int64_t serial_ = 0;
  std::int64_t refused_clouds_ = 0;
  std::string last_refusal_;
  WebServer web_;  // goes first: its handlers use the rest
};

}  // namespace graspd
