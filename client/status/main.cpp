// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-status: the daemon's health, live.
#include <CLI/CLI.hpp>

#include "client/common/lcm_loop.hpp"
#include "client/common/live_text.hpp"
#include "client/common/program.hpp"
#include "client/common/text.hpp"
#include "client/status/status_text.hpp"
#include "service/transport/status_codec.hpp"

namespace graspd {
namespace {

struct Options {
  std::string lcm_url;
  std::string channel = "GRASPD_STATUS";
  std::string format = "text";
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
  app.add_option("-n,--count", o.count, "stop after so many; 0: never")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option(
         "--timeout", o.timeout_s,
         "stop after so many seconds, and fail if there was no status, or fewer than --count; 0: never")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

int show(const CLI::App& app, const Options& o) {
  const std::string url = resolve_lcm_url(o.lcm_url);
  LcmBus bus(url);
  LiveText live;
  std::int64_t shown = 0;
  const auto done = [&] { return o.count > 0 && shown >= o.count; };
  bus.subscribe(o.channel, [&](const Packet& packet) {
    const auto status = decode_status(packet.bytes);
    if (!status) {
      say(app, plain_line(packet.channel) + ": a message that is no valid status_t");
    } else if (!done()) {
      ++shown;
      o.format == "json" ? write_output(status_json(*status) + '\n') : live.show(status_text(*status) + '\n');
    }
  });
  const auto limit =
      o.timeout_s > 0 ? std::optional(std::chrono::duration<double>(o.timeout_s)) : std::nullopt;
  const LoopEnd end = run_loop(bus, limit, done);
  if (end == LoopEnd::kTimeout && (shown == 0 || o.count > 0)) {
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
  return run_program(app, argc, argv, [&] { return show(app, options); });
}
