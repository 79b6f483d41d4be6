// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-view: what graspd sees, live in the browser.
#include <CLI/CLI.hpp>

#include <chrono>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "client/common/frame_publisher.hpp"
#include "client/common/lcm_loop.hpp"
#include "client/common/program.hpp"
#include "client/common/sealed_message.hpp"
#include "client/common/stop_flag.hpp"
#include "client/log/log_parts.hpp"
#include "client/view/log_player.hpp"
#include "client/view/viewer.hpp"
#include "client/web/web_token.hpp"
#include "service/config/config_folders.hpp"

namespace graspd {
namespace {

struct Options {
  std::string lcm_url;
  TokenPlaces token{"", "GRASPD_VIEW_TOKEN"};
  std::string page;
  std::string control_channel;
  ViewerOptions viewer;
};

void add_options(CLI::App& app, Options& o) {
  o.viewer.web.port = 8090;
  add_lcm_url(app, o.lcm_url);
  add_version(app);
  app.add_option(
      "--config", o.viewer.config_file,
      "the daemon's service file: channels, sensor poses and settings (default: graspd's defaults)");
  app.add_option("-p,--port", o.viewer.web.port, "to listen on; 0: a free one")->capture_default_str();
  app.add_option("--address", o.viewer.web.address,
                 "to listen on; one beyond this machine needs a token of yours, and so do its pages")
      ->capture_default_str();
  add_token_file(app, o.token);
  app.add_option("--control-channel", o.control_channel,
                 "where settings go to (default: the configuration's lcm.control_channel)");
  app.add_option("--key", o.viewer.key_file,
                 "open and sign messages with this file's keys (see graspd-keygen)");
  app.add_option("--max-points", o.viewer.frames.max_points, "of larger clouds every n-th point is shown")
      ->check(CLI::Range(1000, 10'000'000))
      ->capture_default_str();
  app.add_option("--log", o.viewer.log_file, "play this event log instead of listening")
      ->excludes("--lcm-url");
  app.add_option("--page", o.page, "folder of the page (default: the installed one)");
}

void prepare(Options& o) {
  o.viewer.web.assets =
      o.page.empty() ? installed_config_folder().parent_path() / "view" : std::filesystem::path(o.page);
  o.viewer.web.token = given_token(o.token);
}

void subscribe(LcmBus& bus, Viewer& viewer) {
  const ServiceConfig& config = viewer.settings().config();
  std::set<std::string> clouds, others{config.lcm.status_channel};
  for (const SourceConfig& source : config.sources) {
    clouds.insert(source.channel);
    others.insert({source.handles_channel, source.segments_channel});
  }
  constexpr int kClouds = 4, kOthers = 100;
  const auto take = [&viewer](const Packet& packet) {
    viewer.take(std::string(packet.channel), packet.bytes, packet.recv_utime);
  };
  for (const std::string& channel : clouds) bus.subscribe(channel, take, kClouds);
  for (const std::string& channel : others) bus.subscribe(channel, take, kOthers);
}

void write_address(Viewer& viewer) {
  const WebServer& web = viewer.pages().web();
  write_output(web.url() + "#token=" + web.token() + "\n");
}

int view_live(const CLI::App& app, const Options& o) {
  const std::string url = resolve_lcm_url(o.lcm_url);
  for (const std::string& warning : receive_buffer_warnings(url)) say(app, warning);
  LcmBus bus(url);
  Viewer viewer(o.viewer);
  const std::string& configured = viewer.settings().config().lcm.control_channel;
  const std::string control_channel = o.control_channel.empty() ? configured : o.control_channel;
  ControlChannel control(bus, control_channel, o.viewer.key_file);
  viewer.use_control(control, !control_channel.empty());
  subscribe(bus, viewer);
  viewer.pages().start();
  write_address(viewer);
  constexpr std::chrono::milliseconds kTick{20};
  while (!stop_requested()) {
    if (bus.wait(kTick) == LcmBus::Wait::kClosed) return exit_code(app, LoopEnd::kClosed, url);
    viewer.look(wall_clock_us());
  }
  return kExitOk;
}

int view_log(const Options& o) {
  LogPlayer player(list_logs({o.viewer.log_file}), seal_keys_of(o.viewer.key_file));
  Viewer viewer(o.viewer);
  if (player.has_segmentations()) viewer.expect_segmentations();
  viewer.on_player([&](const PlayerCommand& command) { player.obey(command, viewer); });
  viewer.pages().start();
  write_address(viewer);
  std::string shown;
  int ticks = 0;
  bool playing = !player.playing();
  auto tick = std::chrono::steady_clock::now();
  do {
    player.advance(tick, viewer);
    viewer.look(player.now_us());
    // Now and then, and at once when it stops or starts.
    const bool changed = std::exchange(playing, player.playing()) != player.playing();
    std::string state = player.json();
    if ((changed || ++ticks % 10 == 0) && state != shown) viewer.show_player(shown = std::move(state));
    tick = std::max(tick + std::chrono::milliseconds(20), std::chrono::steady_clock::now());
  } while (wait_until(tick));
  return kExitOk;
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  using namespace graspd;
  CLI::App app("Serves a page that shows clouds, segments and handles live; prints its address.",
               "graspd-view");
  Options options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] {
    prepare(options);
    return options.viewer.log_file.empty() ? view_live(app, options) : view_log(options);
  });
}
