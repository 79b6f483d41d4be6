// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-log: records chosen channels into LCM event logs.
#include <CLI/CLI.hpp>

#include "client/common/lcm_loop.hpp"
#include "client/common/program.hpp"
#include "client/common/text.hpp"
#include "client/log/recorder.hpp"

namespace graspd {
namespace {

struct Options {
  std::string lcm_url;
  std::string file;
  std::string channel = ".*";
  double max_size_mb = 0;
  double min_free_mb = 200;
  std::int64_t count = 0;
  double timeout_s = 0;
  bool overwrite = false;
};

void add_options(CLI::App& app, Options& o) {
  add_lcm_url(app, o.lcm_url);
  add_version(app);
  app.add_option("file", o.file, "log to write, readable by lcm-logplayer")->required();
  app.add_option("-c,--channel", o.channel, "channels to record: a regular expression for the whole name")
      ->capture_default_str();
  app.add_option("--max-size", o.max_size_mb,
                 "rotate: files FILE.00, FILE.01, ... of at most so many megabytes; 0: one file FILE")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--min-free", o.min_free_mb,
                 "stop recording, and fail, before the disk has less than this free [MB]")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("-n,--count", o.count, "stop after so many messages; 0: never")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--timeout", o.timeout_s,
                 "stop after so many seconds, and fail if --count was not reached; 0: never")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_flag("--overwrite", o.overwrite, "replace files that exist");
}

RecorderConfig recorder_config(const Options& o) {
  constexpr double kMegabyte = 1e6;
  return {o.file, static_cast<std::int64_t>(kMegabyte * o.max_size_mb),
          static_cast<std::int64_t>(kMegabyte * o.min_free_mb),
          o.overwrite ? EventLogFile::Existing::kOverwrite : EventLogFile::Existing::kRefuse};
}

std::string summary(const Recorder& recorder) {
  TextTable table({"channel", "messages", "MB"});
  const auto add = [&](const std::string& name, const ChannelCount& count) {
    table.add({plain_line(name), printed("%lld", static_cast<long long>(count.events)),
               printed("%.1f", 1e-6 * static_cast<double>(count.bytes))});
  };
  for (const auto& [name, count] : recorder.channels()) add(name, count);
  add(printed("all, in %d %s", recorder.files(), recorder.files() == 1 ? "file" : "files"), recorder.total());
  return table.str();
}

int record(const CLI::App& app, const Options& o) {
  const std::string url = resolve_lcm_url(o.lcm_url);
  Recorder recorder(recorder_config(o));
  for (const std::string& warning : receive_buffer_warnings(url)) say(app, warning);
  LcmBus bus(url);
  const auto done = [&] { return o.count > 0 && recorder.total().events >= o.count; };
  constexpr int kQueue = 200;
  bus.subscribe(
      o.channel,
      [&](const Packet& packet) {
        // What LCM sends itself when it starts is nobody's message.
        if (packet.channel == "LCM_SELF_TEST") return;
        if (!done()) recorder.record(packet.recv_utime, packet.channel, packet.bytes);
      },
      kQueue);
  const auto limit =
      o.timeout_s > 0 ? std::optional(std::chrono::duration<double>(o.timeout_s)) : std::nullopt;
  LoopEnd end = LoopEnd::kDone;
  try {
    end = run_loop(bus, limit, done);
  } catch (const EventLogError& error) {
    say(app, error.what());
    say_block(summary(recorder));
    return kExitFailed;
  }
  say_block(summary(recorder));
  if (end == LoopEnd::kTimeout && o.count > 0) {
    say(app, printed("%lld of %lld messages after %g s", static_cast<long long>(recorder.total().events),
                     static_cast<long long>(o.count), o.timeout_s));
    return kExitFailed;
  }
  return exit_code(app, end, url);
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  using namespace graspd;
  CLI::App app("Records channels into an LCM event log.", "graspd-log");
  Options options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] { return record(app, options); });
}
