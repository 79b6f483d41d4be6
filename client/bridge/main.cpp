// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-bridge: graspd for programs that speak JSON over WebSockets.
#include <CLI/CLI.hpp>

#include "client/bridge/bridge.hpp"
#include "client/common/lcm_loop.hpp"
#include "client/common/program.hpp"
#include "client/common/text.hpp"
#include "client/web/web_token.hpp"

namespace graspd {
namespace {

struct Options {
  std::string lcm_url;
  BridgeChannels channels;
  WebConfig web;
  TokenPlaces token{"", "GRASPD_BRIDGE_TOKEN"};
  bool latest_only = false;
  std::string key_file;
};

constexpr std::size_t kMaxCloudBytes = std::size_t{32} << 20;
constexpr std::size_t kMaxWaitingBytes = std::size_t{8} << 20;

void add_options(CLI::App& app, Options& o) {
  o.web.port = 8091;
  o.web.max_waiting_bytes = kMaxWaitingBytes;
  add_lcm_url(app, o.lcm_url);
  add_version(app);
  app.add_option("--address", o.web.address,
                 "address to listen on; one beyond this machine needs a token of yours")
      ->capture_default_str();
  app.add_option("-p,--port", o.web.port, "port to listen on; 0: a free one")->capture_default_str();
  add_token_file(app, o.token);
  app.add_option("--origin", o.web.origins,
                 "pages of this origin may connect, too, for example https://robot.example");
  app.add_option("--handles", o.channels.handles,
                 "channel of handle lists, or a regular expression for the whole name")
      ->capture_default_str();
  app.add_option("--status", o.channels.status,
                 "channel of status messages, or a regular expression for the whole name")
      ->capture_default_str();
  app.add_option("--control-channel", o.channels.control, "where control messages go; empty: none are taken")
      ->capture_default_str();
  app.add_option("--cloud-channel", o.channels.clouds,
                 "where clouds go that come as binary messages (default: none are taken)");
  app.add_flag("--latest", o.latest_only,
               "clients that are too slow miss handle lists instead of being closed");
  app.add_option("--key", o.key_file,
                 "sign what is sent with the first key of this file (see graspd-keygen)");
  app.footer("The first line of standard output is the WebSocket's address with the token.");
}

int bridge(const CLI::App& app, Options& o) {
  o.web.token = given_token(o.token);
  if (!o.channels.clouds.empty()) o.web.max_message_bytes = kMaxCloudBytes;
  const std::string url = resolve_lcm_url(o.lcm_url);
  LcmBus bus(url);
  Bridge bridge(bus, o.channels, o.web, o.latest_only, o.key_file);
  bridge.start();
  std::string address = bridge.web().url();
  address.replace(0, std::string_view("http").size(), "ws");
  write_output(address + o.web.socket_path.substr(1) + "?token=" + bridge.web().token() + '\n');
  std::int64_t told = 0;
  const LoopEnd end = run_loop(
      bus, std::nullopt, [] { return false; },
      [&] {
        if (bridge.invalid() > 0 && std::exchange(told, bridge.invalid()) == 0)
          say(app, "a message that is neither a valid handle_list_t nor status_t; more are only counted");
      });
  if (bridge.invalid() > 0)
    say(app, printed("%lld invalid messages", static_cast<long long>(bridge.invalid())));
  return exit_code(app, end, url);
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  using namespace graspd;
  CLI::App app("Gives handle lists and statuses as JSON over WebSockets, and takes control messages.",
               "graspd-bridge");
  Options options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] { return bridge(app, options); });
}
