// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/bridge/bridge.hpp"

#include <algorithm>
#include <utility>

#include "client/bridge/bridge_message.hpp"
#include "client/common/frame_publisher.hpp"
#include "client/common/handle_text.hpp"
#include "client/status/status_text.hpp"
#include "service/transport/cloud_decoder.hpp"
#include "service/transport/control_codec.hpp"
#include "service/transport/handle_list_codec.hpp"
#include "service/transport/seal_keys.hpp"
#include "service/transport/status_codec.hpp"

namespace graspd {
namespace {

constexpr int kHandlesTopic = 0;
constexpr int kStatusTopic = 1;
constexpr int kQueue = 200;

}  // namespace

Bridge::Bridge(Bus& bus, BridgeChannels channels, WebConfig web, bool latest_only,
               const std::string& key_file)
    : bus_(bus), channels_(std::move(channels)), latest_only_(latest_only), web_(std::move(web), handlers()) {
  if (!key_file.empty()) sealer_.emplace(load_seal_keys(key_file).front());
}

void Bridge::start() {
  bus_.subscribe(
      channels_.handles, [this](const Packet& packet) { handle_list_came(packet); }, kQueue);
  bus_.subscribe(channels_.status, [this](const Packet& packet) { status_came(packet); });
  web_.start();
}

WebHandlers Bridge::handlers() {
  WebHandlers handlers;
  handlers.opened = [this](const WebClient& client) {
    web_.send(client.id, text_message(hello_text(client.may_write)));
  };
  handlers.closed = [](const WebClient&) {};
  handlers.received = [this](const WebClient& client, std::string_view message, bool is_text) {
    received(client, message, is_text);
  };
  return handlers;
}

void Bridge::handle_list_came(const Packet& packet) {
  const auto list = decode_handle_list(packet.bytes);
  if (!list) {
    ++invalid_;
    return;
  }
  const WebMessage message = text_message(envelope("handle_list", packet.channel, handle_list_json(*list)));
  if (latest_only_) {
    web_.broadcast_latest(kHandlesTopic, message);
  } else {
    web_.broadcast(message);
  }
}

void Bridge::status_came(const Packet& packet) {
  const auto status = decode_status(packet.bytes);
  if (!status) {
    ++invalid_;
    return;
  }
  web_.broadcast_latest(kStatusTopic, text_message(envelope("status", packet.channel, status_json(*status))));
}

/// On the web server's thread.
void Bridge::received(const WebClient& client, std::string_view message, bool is_text) {
  std::optional<std::string> answer;
  if (!client.may_write) {
    web_.counters().add(WebEvent::kBadToken);
    answer = refused_text("sending needs the token that graspd-bridge printed: /socket?token=...");
  } else {
    answer = is_text ? take_control(message) : take_cloud(message);
  }
  if (answer) web_.send(client.id, text_message(*answer));
}

std::string Bridge::take_control(std::string_view text) {
  std::string why = "no control messages are taken here";
  auto control = channels_.control.empty() ? std::nullopt : parse_control(text, why);
  if (control) {
    control->utime = wall_clock_us();
    control->id = last_id_ = std::max(last_id_ + 1, control->utime);
    if (publish(channels_.control, encode(*control))) return sent_text(control->id);
    why = "it could not be sent";
  }
  web_.counters().add(WebEvent::kRefusedMessage);
  return refused_text(why);
}

/// The refusal; nothing where it went out.
std::optional<std::string> Bridge::take_cloud(std::string_view bytes) {
  std::string why = "no clouds are taken here (graspd-bridge --cloud-channel)";
  if (!channels_.clouds.empty()) {
    const auto message = std::as_bytes(std::span(bytes.data(), bytes.size()));
    const auto refusal = check_cloud(message, DecodeLimits());
    if (!refusal && publish(channels_.clouds, message)) return std::nullopt;
    why = refusal ? refusal->text : "it could not be sent";
  }
  web_.counters().add(WebEvent::kRefusedMessage);
  return refused_text(why);
}

bool Bridge::publish(const std::string& channel, std::span<const std::byte> message) {
  return bus_.publish(channel, sealer_ ? sealer_->seal(channel, message, wall_clock_us()) : message);
}

}  // namespace graspd
