// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Everything that can be set about the daemon: read from YAML, checked, printed.
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/config/config_error.hpp"
#include "service/config/source_config.hpp"
#include "service/pipeline/config_fields.hpp"
#include "service/pipeline/detect_config.hpp"
#include "service/pipeline/gripper.hpp"
#include "service/transport/refusal.hpp"

namespace graspd {

struct LcmConfig {
  std::string url;  ///< empty: LCM_DEFAULT_URL, else LCM's default group with ttl 0
  std::string status_channel = "GRASPD_STATUS";

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("url", self.url, Range{},
      "LCM URL; empty: the environment's LCM_DEFAULT_URL, else udpm://239.255.76.67:7667?ttl=0");
    v("status_channel", self.status_channel, Range{}, "channel of status_t, sent once a second");
  }
};

struct LimitsConfig {
  DecodeLimits decode;
  int max_sources = 64;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    DecodeLimits::visit(self.decode, v);
    v("max_sources", self.max_sources, Range{1, 1024},
      "channels served at most; messages on further channels are counted and ignored");
  }
};

/// Who may speak. Off without a key file.
struct AuthenticationConfig {
  std::string key_file;
  float max_age_s = 5;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("key_file", self.key_file, Range{},
      "keys of graspd-keygen; with it only messages signed with one of them (sealed_t) are taken; empty: all "
      "are");
    v("max_age_s", self.max_age_s, Range{0.01, 3600},
      "signed messages are refused when their time is this far from ours, earlier or later [s]");
  }
};

/// What happens at SIGINT or SIGTERM to frames that have arrived and are not answered yet.
enum class StopPolicy { kFinish, kDrop };
[[nodiscard]] constexpr std::array<std::string_view, 2> choices(StopPolicy) {
  return {"finish", "drop"};
}

struct ServiceConfig {
  LcmConfig lcm;
  int workers = 2;
  int threads = 0;
  StopPolicy on_stop = StopPolicy::kFinish;
  LimitsConfig limits;
  DetectConfig detect;  ///< what sources start from; each source holds its own in full
  std::vector<SourceConfig> sources{SourceConfig{}};
  AuthenticationConfig authentication;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("lcm", self.lcm, "the bus");
    v("workers", self.workers, Range{1, 64}, "frames in work at the same time at most");
    v("threads", self.threads, Range{0, 256},
      "threads that a frame is split over at most: its worker, and helpers that all workers share; 0: one a "
      "core");
    v("on_stop", self.on_stop, Range{},
      "at SIGINT or SIGTERM, frames that wait or are in work: finish them (for a second at most) or drop "
      "them");
    v("limits", self.limits, "what is refused without looking closer");
    v("authentication", self.authentication, "who may speak");
    v("detect", self.detect, "the method, for every source");
    v("sources", self.sources, "where clouds come from; of two that match a channel, the first one has it");
  }

  /// Names unique, channels usable, and no source listens to what the daemon itself publishes.
  [[nodiscard]] std::optional<ConfigProblem> validate() const;
};

/// Reads a service file. Keys that are missing keep their defaults; anything else that is not as it must be
/// throws ConfigError. Grippers and sensors are found as config/README.md says.
[[nodiscard]] ServiceConfig load_service_config(const std::filesystem::path& file);

/// Reads a gripper file; every key but the name must be there.
[[nodiscard]] Gripper load_gripper(const std::filesystem::path& file);

/// The gripper of that name (a file in grippers/ beside `folder`'s service file or in the installed
/// configuration), or of that path (relative to `folder`).
[[nodiscard]] GripperSetting find_gripper(const std::string& name_or_path,
                                          const std::filesystem::path& folder);

/// The `detect:` part of a service file (empty path: the defaults), then a sensor file's (a name or a path;
/// empty: none).
[[nodiscard]] DetectConfig load_detect_config(const std::filesystem::path& service_file,
                                              const std::string& sensor = {});

/// The complete effective configuration as YAML, every key with its meaning, unit and range; loads back to
/// the same.
[[nodiscard]] std::string print(const ServiceConfig& config);

/// Whether a message on this channel goes to a source with this regular expression. The whole name has to
/// match.
[[nodiscard]] bool matches_channel(const std::string& channel_regex, const std::string& channel);

/// Whether the expression is one channel's name and nothing more.
[[nodiscard]] bool is_plain_channel(std::string_view channel_regex);

}  // namespace graspd
