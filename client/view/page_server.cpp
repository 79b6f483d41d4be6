// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/view/page_server.hpp"

#include <algorithm>
#include <utility>

#include "client/common/json_writer.hpp"

namespace graspd {
namespace {

constexpr int kFrameTopic = 0;      // states have topics above it
constexpr std::size_t kWindow = 2;  // frames on their way to a page

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

}  // namespace

PageServer::PageServer(WebConfig web, FrameMessageOptions options, std::string hello,
                       const Settings& settings, OnCommand on_command)
    : options_(options),
      hello_(std::move(hello)),
      settings_(settings),
      on_command_(std::move(on_command)),
      web_(std::move(web), handlers()) {}

WebHandlers PageServer::handlers() {
  WebHandlers handlers;
  handlers.opened = [this](const WebClient& client) { events_.put({client, PageOpened{}}); };
  handlers.closed = [this](const WebClient& client) { events_.put({client, PageClosed{}}); };
  handlers.received = [this](const WebClient& client, std::string_view text, bool is_text) {
    received(client, text, is_text);
  };
  return handlers;
}

/// On the web server's thread.
void PageServer::received(const WebClient& client, std::string_view text, bool is_text) {
  std::optional<Command> command = is_text ? parse_command(text) : std::nullopt;
  if (!command) {
    refuse(client, "not a command");
  } else if (needs_token(*command) && !client.may_write) {
    web_.counters().add(WebEvent::kBadToken);
    refuse(client, "the page was opened without the token: open it by the address that graspd-view printed");
  } else if (!events_.put({client, *std::move(command)})) {
    refuse(client, "too many commands");
  }
}

void PageServer::tell(const WebClient& client, const std::string& json) {
  web_.send(client.id, text_message(json));
}

void PageServer::refuse(const WebClient& client, const std::string& why) {
  web_.counters().add(WebEvent::kRefusedMessage);
  JsonWriter json;
  tell(client, json.begin_object().member("type", "refused").member("why", why).end_object().str());
}

void PageServer::process() {
  for (PageEvent& event : events_.take_all()) {
    std::visit(Overloaded{[&](PageOpened) { opened(event.client); },
                          [&](PageClosed) { pages_.erase(event.client.id); },
                          [&](const Command& command) {
                            const auto page = pages_.find(event.client.id);
                            if (page != pages_.end()) execute(page->second, command);
                          }},
               event.what);
  }
}

void PageServer::opened(const WebClient& client) {
  Page& page = pages_[client.id];
  page.client = client;
  tell(client, hello_ + ",\"may_write\":" + (client.may_write ? "true" : "false") + "}");
  tell(client, channels_json());
  for (const auto& [topic, json] : states_) web_.send_latest(client.id, topic, text_message(json));
  deliver(page);
}

void PageServer::execute(Page& page, const Command& command) {
  if (const auto* ack = std::get_if<AckCommand>(&command)) {
    std::erase_if(page.not_drawn, [&](std::int64_t serial) { return serial <= ack->serial; });
  } else if (const auto* flow = std::get_if<FlowCommand>(&command)) {
    page.paused = *flow != FlowCommand::kResume;
    page.step = *flow == FlowCommand::kStep;
  } else if (const auto* source = std::get_if<SourceCommand>(&command)) {
    page.channel = source->channel;
    page.sent = 0;
  } else {
    on_command_(page.client, command);
  }
  deliver(page);
}

void PageServer::deliver(Page& page) {
  if ((page.paused && !page.step && page.sent > 0) || page.not_drawn.size() >= kWindow) return;
  const std::string channel = page.channel.empty() && !channels_.empty() ? channels_.front() : page.channel;
  const auto found = frames_.find(channel);
  if (found == frames_.end() || found->second.serial <= page.sent) return;
  const WebMessage& frame = message(found->second);
  if (!frame.bytes) return;
  page.step = false;
  page.sent = found->second.serial;
  page.not_drawn.push_back(page.sent);
  web_.send_latest(page.client.id, kFrameTopic, frame);
}

const WebMessage& PageServer::message(Latest& latest) {
  if (latest.message.bytes || latest.frame.cloud.empty()) return latest.message;
  const auto made = make_frame_message(latest.frame, latest.serial,
                                       settings_.T_target_cloud(latest.frame.channel), options_);
  if (const auto* refusal = std::get_if<Refusal>(&made)) {
    ++refused_clouds_;
    last_refusal_ = refusal->text;
    latest.frame.cloud.clear();
  } else {
    latest.message = binary_message(std::get<std::string>(made));
  }
  return latest.message;
}

void PageServer::show(MatchedFrame frame) {
  const std::string channel = frame.channel;
  frames_[channel] = {std::move(frame), ++serial_, {}};
  if (std::find(channels_.begin(), channels_.end(), channel) == channels_.end()) {
    channels_.push_back(channel);
    web_.broadcast(text_message(channels_json()));
  }
  for (auto& [id, page] : pages_) deliver(page);
}

void PageServer::clear() {
  frames_.clear();
}

void PageServer::show_state(int topic, const std::string& json) {
  states_[topic] = json;
  web_.broadcast_latest(topic, text_message(json));
}

std::string PageServer::channels_json() const {
  JsonWriter json;
  json.begin_object().member("type", "channels").key("channels").begin_array();
  for (const std::string& channel : channels_) json.value(channel);
  return json.end_array().end_object().str();
}

std::string PageServer::statistics() const {
  JsonWriter json;
  json.begin_object().member("type", "server").member("pages", pages()).member("frames", serial_);
  json.member("refused_clouds", refused_clouds_).member("last_refusal", last_refusal_);
  json.key("counters").begin_object();
  for (std::size_t i = 0; i < kNumWebEvents; ++i) {
    const auto event = static_cast<WebEvent>(i);
    json.member(name(event), web_.counters().get(event));
  }
  return json.end_object().end_object().str();
}

}  // namespace graspd
