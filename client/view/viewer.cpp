// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/view/viewer.hpp"

#include <limits>
#include <utility>
#include <variant>

#include "client/common/frame_publisher.hpp"
#include "client/common/json_writer.hpp"
#include "client/status/status_text.hpp"
#include "service/transport/cloud_decoder.hpp"
#include "service/transport/handle_list_codec.hpp"
#include "service/transport/seal_keys.hpp"
#include "service/transport/segmentation_codec.hpp"
#include "service/transport/segmentation_request_codec.hpp"
#include "service/transport/status_codec.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

enum Topic : int { kStatusTopic = 1, kSettingsTopic, kServerTopic, kPlayerTopic };

std::string hello(const ViewerOptions& options) {
  JsonWriter json;
  json.begin_object().member("type", "hello").member("mode", options.log_file.empty() ? "live" : "log");
  return json.member("log", options.log_file).str();
}

SealVerifier make_verifier(const ViewerOptions& options, const ServiceConfig& config) {
  if (options.key_file.empty()) return {};
  // A log's messages are as old as they are.
  constexpr double kMicroseconds = 1e6;
  const double age_us = static_cast<double>(config.authentication.max_age_s) * kMicroseconds;
  return {load_seal_keys(options.key_file), options.log_file.empty()
                                                ? static_cast<std::int64_t>(age_us)
                                                : std::numeric_limits<std::int64_t>::max() / 4};
}

}  // namespace

Viewer::Viewer(const ViewerOptions& options)
    : options_(options),
      settings_(options.config_file),
      verifier_(make_verifier(options, settings_.config())),
      pages_(options.web, options.frames, hello(options), settings_,
             [this](const WebClient& client, const Command& command) { execute(client, command); }),
      matcher_([this](MatchedFrame frame) { pages_.show(std::move(frame)); }) {
  show_settings();
}

void Viewer::use_control(ControlChannel& control, bool daemon_listens) {
  control_ = &control;
  daemon_listens_ = daemon_listens;
  show_settings();
}

void Viewer::take(const std::string& channel, std::span<const std::byte> message, std::int64_t now_us) {
  if (fingerprint(message) != kSealedFingerprint) return take_opened(channel, message, now_us);
  const auto opened = verifier_.open(channel, message, wall_clock_us());
  if (const auto* inside = std::get_if<std::span<const std::byte>>(&opened))
    take_opened(channel, *inside, now_us);
}

void Viewer::take_opened(const std::string& channel, std::span<const std::byte> message,
                         std::int64_t now_us) {
  const std::optional<std::uint64_t> type = fingerprint(message);
  if (type == kHandleListFingerprint) {
    if (const auto list = decode_handle_list(message)) matcher_.add_list(*list, now_us);
  } else if (type == kSegmentationFingerprint) {
    if (const auto made = decode_segmentation(message))
      matcher_.add_segmentation(made->source_channel, made->utime, made->seq, message, now_us);
  } else if (type == kStatusFingerprint) {
    take_status(message);
  } else if (type == kPointCloudFingerprint || type == kDepthImageFingerprint) {
    matcher_.add_cloud(channel, peek_header(message, options_.frames.limits), message, now_us);
  }
}

void Viewer::take_status(std::span<const std::byte> message) {
  const auto status = decode_status(message);
  if (!status) return;
  if (settings_.use_overrides(status->overrides)) show_settings();
  pages_.show_state(kStatusTopic, "{\"type\":\"status\",\"status\":" + status_json(*status) + "}");
}

void Viewer::look(std::int64_t now_us) {
  pages_.process();
  matcher_.look(now_us);
  const auto now = std::chrono::steady_clock::now();
  if (now < next_second_) return;
  next_second_ = now + std::chrono::seconds(1);
  pages_.show_state(kServerTopic, pages_.statistics());
  if (control_ != nullptr && pages_.pages() > 0) ask_for_segments();
}

/// Lasts until the next time, and a little longer.
void Viewer::ask_for_segments() {
  const std::string& channel = settings_.config().lcm.request_channel;
  segmentation_request_t request;
  request.utime = wall_clock_us();
  request.seconds = 2.5;
  if (!channel.empty()) control_->publish(channel, encode(request));
}

void Viewer::clear() {
  matcher_.clear();
  pages_.clear();
}

void Viewer::show_player(const std::string& json) {
  pages_.show_state(kPlayerTopic, json);
}

void Viewer::show_settings() {
  pages_.show_state(kSettingsTopic, settings_.json(control_ != nullptr && daemon_listens_));
}

void Viewer::execute(const WebClient& client, const Command& command) {
  if (const auto* set = std::get_if<SetCommand>(&command)) {
    if (const auto problem = settings_.problem(*set)) return pages_.refuse(client, *problem);
    change_settings(client, control_t::SET, settings_.yaml(*set));
  } else if (const auto* config = std::get_if<ConfigCommand>(&command)) {
    change_settings(client, *config == ConfigCommand::kUndo ? control_t::UNDO : control_t::RESET, "");
  } else if (const auto* player = std::get_if<PlayerCommand>(&command)) {
    if (!player_) return pages_.refuse(client, "there is no log to play");
    player_(*player);
  }
}

void Viewer::change_settings(const WebClient& client, std::int8_t command, const std::string& yaml) {
  if (control_ == nullptr || !daemon_listens_) {
    return pages_.refuse(
        client, "the daemon takes no control messages: its configuration names no lcm.control_channel");
  }
  const std::optional<std::int64_t> id = control_->send(command, yaml);
  if (!id) return pages_.refuse(client, "LCM could not send it");
  JsonWriter json;
  pages_.tell(client, json.begin_object().member("type", "sent").member("id", *id).end_object().str());
}

}  // namespace graspd
