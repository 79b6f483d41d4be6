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
  std::string control_channel;
  std::string request_channel = "GRASPD_REQUESTS";
  double retry_longest_s = 5;
  double give_up_s = 0;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    v("url", self.url, Range{},
      "LCM URL; empty: the environment's LCM_DEFAULT_URL, else udpm://239.255.76.67:7667?ttl=0");
    v("status_channel", self.status_channel, Range{}, "channel of status_t, sent once a second");
    v("control_channel", self.control_channel, Range{},
      "channel of control_t, for example GRASPD_CONTROL; empty: nobody can change settings over LCM");
    v("request_channel", self.request_channel, Range{},
      "channel of segmentation_request_t, by which a viewer asks for segments; empty: nobody can");
    v("retry_longest_s", self.retry_longest_s, Range{0.1, 3600},
      "while LCM cannot be had or was lost, attempts are up to this far apart [s]");
    v("give_up_s", self.give_up_s, Range{0, 1e6}, "graspd ends when LCM is away for so long [s]; 0: never");
  }
};

struct LimitsConfig {
  DecodeLimits decode;
  int max_sources = 64;
  int max_waiting_bytes = 1 << 30;
  int max_waiting_answers = 1000;
  int max_log_lines = 1024;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& v) {
    DecodeLimits::visit(self.decode, v);
    v("max_sources", self.max_sources, Range{1, 1024},
      "channels served at most; messages on further channels are counted and ignored");
    v("max_waiting_bytes", self.max_waiting_bytes, Range{1 << 20, 2e9},
      "messages of all sources that wait or are in work [bytes]; frames beyond are answered OVERLOADED");
    v("max_waiting_answers", self.max_waiting_answers, Range{2, 100000},
      "answers of a channel that wait for that of an earlier frame; beyond, that frame is given up");
    v("max_log_lines", self.max_log_lines, Range{16, 100000},
      "lines that wait to be written to the log; beyond, the oldest are lost and counted");
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
  ServiceConfig() = default;

  LcmConfig lcm;
  int workers = 2;
  int threads = 0;
  StopPolicy on_stop = StopPolicy::kFinish;
  double watchdog_s = 10;
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
    v("watchdog_s", self.watchdog_s, Range{0, 3600},
      "a frame in work for longer is answered FAILED, and systemd's watchdog is not fed any more [s]; 0: "
      "never");
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

/// What a daemon's configuration is made of, each on top of the one before.
struct ConfigLayers {
  std::filesystem::path file;  ///< the service file; empty: built-in defaults
  std::optional<int> workers;  ///< of the command line, as the next three
  std::optional<int> threads;
  std::string lcm_url;
  std::string gripper;    ///< for all sources; a path is relative to the current folder
  std::string overrides;  ///< of control messages: YAML with the keys of a service file
};

/// Reads the file again and puts the rest on top; sources of the overrides are told by their name. Throws as
/// load_service_config() does.
[[nodiscard]] ServiceConfig load_layers(const ConfigLayers& layers);

/// More than this the overrides must not become [bytes].
inline constexpr std::size_t kMaxOverridesBytes = 16'383;

/// `text` on top of `overrides`, both YAML. Throws ConfigError where it is not a map, too large, or no YAML;
/// keys and values are looked at by load_layers().
[[nodiscard]] std::string merge_overrides(const std::string& overrides, const std::string& text);

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

/// The first source that messages on this channel go to, as an index; as many as there are sources: none.
[[nodiscard]] std::size_t first_source(const ServiceConfig& config, const std::string& channel);

/// Whether the daemon itself publishes, or obeys, on this channel.
[[nodiscard]] bool is_own_channel(const ServiceConfig& config, std::string_view channel);

/// Whether the expression is one channel's name and nothing more.
[[nodiscard]] bool is_plain_channel(std::string_view channel_regex);

}  // namespace graspd
