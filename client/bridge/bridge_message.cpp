// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/bridge/bridge_message.hpp"

#include <nlohmann/json.hpp>

#include "client/common/json_writer.hpp"
#include "service/transport/message_parts.hpp"

namespace graspd {
namespace {

using Json = nlohmann::json;

// LCM's constants have no address, so a copy is what an optional can take.
std::optional<std::int8_t> command_of(const std::string& name) {
  if (name == "reload") return std::int8_t{control_t::RELOAD};
  if (name == "set") return std::int8_t{control_t::SET};
  if (name == "undo") return std::int8_t{control_t::UNDO};
  if (name == "reset") return std::int8_t{control_t::RESET};
  return std::nullopt;
}

/// A string member; nothing where it is absent or something else.
std::optional<std::string> text_member(const Json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end() || !found->is_string()) return std::nullopt;
  return found->get<std::string>();
}

}  // namespace

std::string hello_text(bool may_write) {
  JsonWriter json;
  json.begin_object().member("type", "hello").member("version", GRASPD_VERSION);
  return json.str() + ",\"may_write\":" + (may_write ? "true" : "false") + "}";
}

std::string envelope(std::string_view type, std::string_view channel, std::string_view message) {
  JsonWriter json;
  json.begin_object().member("type", type).member("channel", channel);
  return json.str() + ",\"message\":" + std::string(message) + "}";
}

std::string sent_text(std::int64_t id) {
  JsonWriter json;
  return json.begin_object().member("type", "sent").member("id", id).end_object().str();
}

std::string refused_text(std::string_view why) {
  JsonWriter json;
  return json.begin_object().member("type", "refused").member("why", why).end_object().str();
}

std::optional<control_t> parse_control(std::string_view text, std::string& why) {
  const Json object = Json::parse(text, nullptr, false);
  if (!object.is_object() || text_member(object, "type") != "control") {
    why = "expected a JSON object with \"type\":\"control\"";
    return std::nullopt;
  }
  const auto command = command_of(text_member(object, "command").value_or(""));
  if (!command) {
    why = "expected \"command\": reload, set, undo or reset";
    return std::nullopt;
  }
  const bool is_set = *command == control_t::SET;
  const auto settings = text_member(object, "text");
  if (is_set != settings.has_value() || object.size() != (is_set ? 3u : 2u)) {
    why = is_set ? "expected type, command and \"text\": the settings in YAML, and no more"
                 : "expected type and command, and no more";
    return std::nullopt;
  }
  // A string on the wire ends at its first NUL.
  if (is_set && (settings->size() > kMaxOverridesLength || settings->find('\0') != std::string::npos)) {
    why = "\"text\" is too long, or has a NUL inside";
    return std::nullopt;
  }
  control_t control{};
  control.command = *command;
  control.text = settings.value_or("");
  return control;
}

}  // namespace graspd
