// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>

#include "client/common/program.hpp"
#include "client/common/sealed_message.hpp"
#include "client/common/stop_flag.hpp"
#include "client/common/text.hpp"
#include "client/log/log_parts.hpp"
#include "client/replay/commands.hpp"
#include "client/replay/player.hpp"
#include "service/config/config_error.hpp"
#include "service/transport/lcm_bus.hpp"

namespace graspd {
namespace {

using Clock = std::chrono::steady_clock;

/// What people ask for: lines on standard input, single keys where it is a terminal.
class Controls {
 public:
  Controls() : terminal_(isatty(STDIN_FILENO) != 0 && tcgetattr(STDIN_FILENO, &before_) == 0) {
    if (!terminal_) return;
    termios raw = before_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    tcsetattr(STDIN_FILENO, TCSANOW, &raw);
  }
  ~Controls() {
    if (terminal_) tcsetattr(STDIN_FILENO, TCSANOW, &before_);
  }
  Controls(const Controls&) = delete;
  Controls& operator=(const Controls&) = delete;

  /// Waits so long at most; the commands that have come.
  std::vector<std::string> wait(std::chrono::milliseconds longest) {
    pollfd input{open_ ? STDIN_FILENO : -1, POLLIN, 0};
    if (poll(&input, 1, static_cast<int>(longest.count())) <= 0 || input.revents == 0) return {};
    std::array<char, 256> bytes{};
    const ssize_t size = read(STDIN_FILENO, bytes.data(), bytes.size());
    open_ = size > 0;
    if (!open_) return {};
    buffer_.append(bytes.data(), static_cast<std::size_t>(size));
    return terminal_ ? keys() : lines();
  }

 private:
  std::vector<std::string> lines() {
    std::vector<std::string> found;
    for (std::size_t end = buffer_.find('\n'); end != std::string::npos; end = buffer_.find('\n')) {
      found.push_back(buffer_.substr(0, end));
      buffer_.erase(0, end + 1);
    }
    // Nobody types a line like that.
    if (buffer_.size() > 4096) buffer_.clear();
    return found;
  }

  std::vector<std::string> keys() {
    static const std::vector<std::pair<std::string, std::string>> kKeys{
        {"\x1b[C", "skip 10"}, {"\x1b[D", "skip -10"}, {" ", "toggle"},
        {"+", "faster"},       {"-", "slower"},        {"q", "quit"}};
    std::vector<std::string> found;
    while (!buffer_.empty()) {
      const auto key = std::find_if(kKeys.begin(), kKeys.end(),
                                    [&](const auto& k) { return buffer_.starts_with(k.first); });
      if (key != kKeys.end()) found.push_back(key->second);
      buffer_.erase(0, key != kKeys.end() ? key->first.size() : 1);
    }
    return found;
  }

  bool terminal_;
  bool open_ = true;
  termios before_{};
  std::string buffer_;
};

struct PlayOptions {
  std::vector<std::string> logs;
  std::string lcm_url;
  std::string key_file;
  std::string channels = ".*";
  double speed = 1;
  double start_s = 0;
  bool paused = false;
  bool stay = false;
  bool scan = false;
};

/// False: it is to end.
bool obey(const CLI::App& app, Player& player, const std::string& command) {
  if (command == "quit") return false;
  std::string translated = command;
  if (command == "faster") translated = printed("speed %.9g", 2 * player.speed());
  if (command == "slower") translated = printed("speed %.9g", player.speed() / 2);
  if (!player.obey(translated, Clock::now()))
    say(app, "not a command: " + plain_line(command) + " (pause, play, seek S, skip S, speed X, quit)");
  return true;
}

void show(const Player& player) {
  if (isatty(STDERR_FILENO) == 0) return;
  std::fprintf(stderr, "\r%s %.1f s, speed %g; space: pause, arrows: 10 s, + -: speed, q: quit \x1b[K",
               player.paused() ? "paused at" : "at", player.position_s(Clock::now()), player.speed());
}

int play(const CLI::App& app, const PlayOptions& o) {
  std::vector<LogPart> parts;
  for (const auto& log : list_logs(o.logs)) parts.push_back({log});
  LcmBus bus(resolve_lcm_url(o.lcm_url));
  std::optional<Player> made;
  try {
    made.emplace(std::move(parts), o.channels, o.speed, Clock::now(), o.scan);
  } catch (const std::regex_error&) {
    throw ConfigError("--channel: not a regular expression: " + o.channels);
  }
  Player& player = *made;
  if (o.start_s > 0) (void)player.obey(printed("seek %.9g", o.start_s), Clock::now());
  if (o.paused) (void)player.obey("pause", Clock::now());
  Controls controls;
  const std::vector<SealKey> keys = seal_keys_of(o.key_file);
  std::int64_t sent = 0, lost = 0;
  bool goes_on = true;
  while (goes_on && !stop_requested() && (o.stay || !player.ended())) {
    const auto due = player.due();
    constexpr std::chrono::milliseconds kSlice{50};
    const auto wait = due ? std::clamp(std::chrono::floor<std::chrono::milliseconds>(*due - Clock::now()),
                                       std::chrono::milliseconds(0), kSlice)
                          : kSlice;
    for (const std::string& command : controls.wait(wait))
      if (goes_on) goes_on = obey(app, player, command);
    show(player);
    if (const auto now_due = player.due(); goes_on && now_due && *now_due <= Clock::now()) {
      const LoggedEvent event = player.take();
      ++(bus.publish(event.channel, opened(keys, event.channel, event.bytes)) ? sent : lost);
    }
  }
  if (isatty(STDERR_FILENO) != 0) std::fputc('\n', stderr);
  for (const std::string& note : player.notes()) say(app, note);
  say(app, printed("%lld messages sent", static_cast<long long>(sent)));
  if (lost > 0) say(app, printed("%lld could not be sent", static_cast<long long>(lost)));
  return lost > 0 ? kExitFailed : kExitOk;
}

}  // namespace

int play_main(int argc, char** argv) {
  CLI::App app("Sends the messages of logs over LCM, at the speed at which they were recorded.",
               "graspd-replay play");
  PlayOptions o;
  add_lcm_url(app, o.lcm_url);
  app.add_option("logs", o.logs, "event logs, as for graspd-replay")->required();
  app.add_option("-c,--channel", o.channels, "channels to send: a regular expression for the whole name")
      ->capture_default_str();
  app.add_option("--key", o.key_file, "send what signed messages (sealed_t) hold");
  app.add_option("--speed", o.speed, "times as fast as it was")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  app.add_option("--start", o.start_s, "begin so many seconds after the first event")
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--paused", o.paused, "wait for the command play");
  app.add_flag("--stay", o.stay, "at the end wait for a seek, or quit");
  app.add_flag("--scan", o.scan, "seek by reading all headers, not by looking for times as in logs in order");
  app.footer(
      "Keys on a terminal: space, left, right, + and -, q. Else lines on standard input: pause, play,\n"
      "seek SECONDS, skip SECONDS, speed FACTOR, quit.");
  return run_program(app, argc, argv, [&] { return play(app, o); });
}

}  // namespace graspd
