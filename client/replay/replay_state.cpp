// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/replay_state.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "client/common/replace_file.hpp"

namespace graspd {
namespace {

using nlohmann::json;

json to_json(const ReplayState& s) {
  return {{"log", s.input.part},
          {"offset", s.input.offset},
          {"skipped_bytes", s.input.skipped},
          {"frames_seen", s.frames_seen},
          {"frames", s.frames},
          {"kept", s.kept},
          {"handles", s.handles},
          {"answers", s.answers},
          {"output_bytes", s.output_bytes},
          {"output_events", s.output_events}};
}

ReplayState state_from(const json& j) {
  ReplayState s;
  s.input = {j.at("log").get<std::size_t>(), j.at("offset").get<std::int64_t>(),
             j.at("skipped_bytes").get<std::int64_t>()};
  j.at("frames_seen").get_to(s.frames_seen);
  j.at("frames").get_to(s.frames);
  j.at("kept").get_to(s.kept);
  j.at("handles").get_to(s.handles);
  j.at("answers").get_to(s.answers);
  j.at("output_bytes").get_to(s.output_bytes);
  j.at("output_events").get_to(s.output_events);
  return s;
}

/// Nothing for what is no JSON object.
std::optional<json> load(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) return std::nullopt;
  json content = json::parse(stream, nullptr, false);
  return content.is_object() ? std::optional(std::move(content)) : std::nullopt;
}

}  // namespace

void save_state(const std::filesystem::path& file, const std::string& identity, const ReplayState& state) {
  replace_file(file, json{{"identity", identity}, {"state", to_json(state)}}.dump() + '\n');
}

void save_receipt(const std::filesystem::path& file, const Receipt& receipt) {
  const json content{
      {"identity", receipt.identity}, {"state", to_json(receipt.state)}, {"sha256", receipt.sha256}};
  replace_file(file, content.dump(2) + '\n');
}

std::optional<ReplayState> load_state(const std::filesystem::path& file, const std::string& identity) {
  const auto content = load(file);
  if (!content) return std::nullopt;
  try {
    if (content->at("identity").get<std::string>() != identity)
      throw std::runtime_error(file.string() + ": of a run with other logs, options or version");
    return state_from(content->at("state"));
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

std::optional<Receipt> load_receipt(const std::filesystem::path& file) {
  const auto content = load(file);
  if (!content) return std::nullopt;
  try {
    return Receipt{content->at("identity").get<std::string>(), state_from(content->at("state")),
                   content->at("sha256").get<std::string>()};
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

}  // namespace graspd
