// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/service_loop.hpp"

#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "service/daemon/daemon.hpp"
#include "service/daemon/notifier.hpp"
#include "service/daemon/signals.hpp"
#include "service/daemon/version.hpp"
#include "service/runtime/clock.hpp"
#include "service/runtime/log.hpp"
#include "service/transport/lcm_url.hpp"
#include "service/transport/network_check.hpp"
#include "service/transport/reconnecting_bus.hpp"

namespace graspd {
namespace {

constexpr int kFailed = 1;

void log_start(Log& log, const ServiceConfig& config, const std::filesystem::path& file,
               const std::string& url) {
  std::string sources;
  for (const SourceConfig& source : config.sources)
    sources += (sources.empty() ? "" : ",") + source.name + ":" + source.channel;
  const std::string from = file.empty() ? "built-in" : file.string();
  log.info("started", {{"version", kVersion},
                       {"config", from},
                       {"url", url},
                       {"sources", sources},
                       {"workers", config.workers},
                       {"threads", threads_a_frame(config)}});
  for (const NetworkWarning& warning : network_warnings(url))
    log.warning(warning.kind, {{"text", warning.text}});
}

RetryTimes retry_times(const LcmConfig& config) {
  RetryTimes times;
  times.longest = std::chrono::milliseconds(static_cast<int>(1000 * config.retry_longest_s));
  return times;
}

/// What happens around the daemon's steps.
class ServiceLoop {
 public:
  ServiceLoop(const ConfigLayers& layers, const ServiceConfig& config)
      : config_(config),
        log_(clock_, static_cast<std::size_t>(config.limits.max_log_lines)),
        notifier_(clock_),
        url_(resolve_lcm_url(config.lcm.url)),
        bus_(url_, retry_times(config.lcm),
             {[this](const std::string& why) { lost(why); }, [this] { restored(); }}),
        daemon_(config, bus_, clock_, log_, [layers](const std::string& overrides) {
          ConfigLayers all = layers;
          all.overrides = overrides;
          return load_layers(all);
        }) {
    log_start(log_, config, layers.file, url_);
  }

  int run() {
    int exit_code = 0;
    std::string_view reason;
    while (reason.empty()) {
      if (daemon_.step() == Bus::Wait::kClosed) {
        log_.error("lcm_closed", {{"url", url_}});
        reason = "lcm_closed";
        exit_code = kFailed;
      } else if (away_too_long()) {
        reason = "lcm_away";
        exit_code = kFailed;
      } else {
        reason = signals_.received();
      }
      if (reason == "SIGHUP") {
        reload();
        reason = {};
      }
      tell_systemd();
    }
    return end(reason, exit_code);
  }

 private:
  void lost(const std::string& why) {
    away_since_ = clock_.now();
    log_.error("lcm_away", {{"reason", why}});
    notifier_.status("waiting for LCM: " + why);
  }
  void restored() {
    away_since_.reset();
    log_.info("lcm_back", {{"url", url_}});
  }
  [[nodiscard]] bool away_too_long() const {
    return away_since_ && config_.lcm.give_up_s > 0 &&
           seconds(clock_.now() - *away_since_) > config_.lcm.give_up_s;
  }

  void reload() {
    if (ready_) notifier_.reloading();
    daemon_.reload();
    if (ready_) notifier_.ready();
  }

  void tell_systemd() {
    // A frame that is stuck is what the watchdog is for; a bus that is away is waited for.
    if (daemon_.num_stuck() == 0) notifier_.alive();
    if (!ready_ && bus_.connected()) {
      ready_ = true;
      notifier_.ready();
    }
    if (daemon_.num_statuses() == told_statuses_) return;
    told_statuses_ = daemon_.num_statuses();
    if (bus_.connected()) notifier_.status(daemon_.summary());
    if (!ready_) notifier_.starting(std::chrono::seconds(30));
  }

  int end(std::string_view reason, int exit_code) {
    notifier_.stopping();
    const bool finished = daemon_.stop();
    log_.info("stopped", {{"reason", reason}, {"finished", finished ? "true" : "false"}});
    const bool written = log_.flush();
    // The destructors would wait for the frame that is still in work, or for whoever does not read the log,
    // longer than a supervisor does.
    if (!finished || !written) std::_Exit(exit_code);
    return exit_code;
  }

  const Signals signals_;  // first: before any thread
  const SystemClock clock_;
  const ServiceConfig config_;
  Log log_;
  Notifier notifier_;
  const std::string url_;
  std::optional<Clock::TimePoint> away_since_;
  bool ready_ = false;
  std::int64_t told_statuses_ = 0;
  ReconnectingBus bus_;
  Daemon daemon_;
};

}  // namespace

int serve(const ConfigLayers& layers, const ServiceConfig& config) {
  ServiceLoop loop(layers, config);
  return loop.run();
}

}  // namespace graspd
