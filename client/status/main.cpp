// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-status: the daemon's health, live.
#include <CLI/CLI.hpp>

#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "client/common/lcm_loop.hpp"
#include "client/common/live_text.hpp"
#include "client/common/program.hpp"
#include "client/common/replace_file.hpp"
#include "client/common/text.hpp"
#include "client/status/prometheus.hpp"
#include "client/status/status_text.hpp"
#include "service/transport/status_codec.hpp"

namespace graspd {
namespace {

// A daemon says how it is once a second; one that is silent for so long is taken for down.
constexpr double kSilence_s = 5;

struct Options {
  std::string lcm_url;
  std::string channel = "GRASPD_STATUS";
  std::string format = "text";
  std::string prometheus;
  bool once = false;
  std::int64_t count = 0;
  double timeout_s = 0;
};

void add_options(CLI::App& app, Options& o) {
  add_lcm_url(app, o.lcm_url);
  add_version(app);
  app.add_option("-c,--channel", o.channel, "channel of status messages")->capture_default_str();
  app.add_option("-f,--format", o.format, "text (a live table) or json (a line a status)")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  app.add_option(
      "--prometheus", o.prometheus,
      "write each status to this file instead, for the node exporter's textfile collector; replaced as a "
      "whole; graspd_up is 0 while none is heard");
  app.add_flag("--once", o.once, "one status, then stop; fail when there is none within 5 s, or --timeout");
  app.add_option("-n,--count", o.count, "stop after so many; 0: never")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option(
         "--timeout", o.timeout_s,
         "stop after so many seconds, and fail if there was no status, or fewer than --count; 0: never")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

/// Where statuses go to.
class Output {
 public:
  explicit Output(const Options& options) : options_(options) {}

  void show(const status_t& status) {
    heard_ = Clock::now();
    if (!options_.prometheus.empty()) {
      replace_file(options_.prometheus, prometheus_text(status));
      down_ = false;
    } else if (options_.format == "json") {
      write_output(status_json(status) + '\n');
    } else {
      live_.show(status_text(status) + '\n');
    }
  }
  /// To be called now and then.
  void look_for_silence() {
    if (std::chrono::duration<double>(Clock::now() - heard_).count() > kSilence_s) show_down();
  }
  void show_down() {
    if (options_.prometheus.empty() || std::exchange(down_, true)) return;
    replace_file(options_.prometheus, prometheus_down());
  }

 private:
  using Clock = std::chrono::steady_clock;
  const Options& options_;
  LiveText live_;
  Clock::time_point heard_ = Clock::now();
  bool down_ = false;
};

int show(const CLI::App& app, const Options& o) {
  const std::string url = resolve_lcm_url(o.lcm_url);
  LcmBus bus(url);
  Output output(o);
  std::int64_t shown = 0;
  const auto done = [&] { return o.count > 0 && shown >= o.count; };
  bus.subscribe(o.channel, [&](const Packet& packet) {
    const auto status = decode_status(packet.bytes);
    if (!status) {
      say(app, plain_line(packet.channel) + ": a message that is no valid status_t");
    } else if (!done()) {
      ++shown;
      output.show(*status);
    }
  });
  const auto limit =
      o.timeout_s > 0 ? std::optional(std::chrono::duration<double>(o.timeout_s)) : std::nullopt;
  const LoopEnd end = run_loop(bus, limit, done, [&] { output.look_for_silence(); });
  if (end == LoopEnd::kTimeout && (shown == 0 || o.count > 0)) {
    if (shown == 0) output.show_down();
    say(app, printed("%lld status messages on %s within %g s: is graspd running?",
                     static_cast<long long>(shown), o.channel.c_str(), o.timeout_s));
    return kExitFailed;
  }
  return exit_code(app, end, url);
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  using namespace graspd;
  CLI::App app("Shows the health of a running graspd.", "graspd-status");
  Options options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] {
    if (options.once) {
      options.count = 1;
      if (options.timeout_s == 0) options.timeout_s = kSilence_s;
    }
    return show(app, options);
  });
}
