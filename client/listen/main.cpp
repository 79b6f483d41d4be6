// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-listen: handle lists as text, CSV or JSON lines.
#include <CLI/CLI.hpp>
#include <map>

#include "client/common/answer_summary.hpp"
#include "client/common/handle_csv.hpp"
#include "client/common/handle_text.hpp"
#include "client/common/lcm_loop.hpp"
#include "client/common/live_text.hpp"
#include "client/common/program.hpp"
#include "client/common/text.hpp"
#include "service/transport/handle_list_codec.hpp"

namespace graspd {
namespace {

struct Options {
  std::string lcm_url;
  std::string channel = "GRASPD_HANDLES";
  std::string format = "text";
  std::int64_t count = 0;
  double timeout_s = 0;
  std::size_t max_rows = 10;
  bool empty_rows = false;
  bool summary = false;
};

void add_options(CLI::App& app, Options& o) {
  add_lcm_url(app, o.lcm_url);
  add_version(app);
  app.add_option("-c,--channel", o.channel,
                 "channel of handle lists, or a regular expression for the whole name")
      ->capture_default_str();
  app.add_option("-f,--format", o.format, "text (a live table), csv, or json (a line a list)")
      ->check(CLI::IsMember({"text", "csv", "json"}))
      ->capture_default_str();
  app.add_option("-n,--count", o.count, "stop after so many lists; 0: never")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--timeout", o.timeout_s,
                 "stop after so many seconds, and fail if --count was not reached; 0: never")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--rows", o.max_rows, "text: handles shown of a list")->capture_default_str();
  app.add_flag("--empty-rows", o.empty_rows, "csv: a line with id -1 for lists without handles");
  app.add_flag("--summary", o.summary, "at the end: answers by status, latency, handles per frame");
}

/// Writes each list as it comes.
class Printer {
 public:
  explicit Printer(const Options& options) : o_(options) {
    if (o_.format == "csv") write_output(handle_csv_header());
  }

  void print(const handle_list_t& list) {
    if (o_.format == "csv") {
      const std::string rows =
          handle_csv_rows(list, o_.empty_rows ? EmptyLists::kWriteRow : EmptyLists::kSkip);
      if (!rows.empty()) write_output(rows);
    } else if (o_.format == "json") {
      write_output(handle_list_json(list) + '\n');
    } else {
      print_text(list);
    }
  }

 private:
  void print_text(const handle_list_t& list) {
    const std::string block = handle_list_line(list) + '\n' + handle_table(list, o_.max_rows) + '\n';
    if (!live_.on_terminal()) {
      write_output(block);
      return;
    }
    // The newest list of each source, under each other.
    blocks_[list.source_channel] = block;
    std::string screen;
    for (const auto& [channel, text] : blocks_) screen += text;
    live_.show(screen);
  }

  const Options& o_;
  LiveText live_;
  std::map<std::string, std::string> blocks_;
};

int listen(const CLI::App& app, const Options& o) {
  const std::string url = resolve_lcm_url(o.lcm_url);
  for (const std::string& warning : receive_buffer_warnings(url)) say(app, warning);
  LcmBus bus(url);
  Printer printer(o);
  AnswerSummary summary;
  std::int64_t invalid = 0;
  constexpr int kQueue = 200;
  bus.subscribe(
      o.channel,
      [&](const Packet& packet) {
        // What is in the queue beyond the last list that was asked for.
        if (o.count > 0 && summary.answers() >= o.count) return;
        const auto list = decode_handle_list(packet.bytes);
        if (!list) {
          if (++invalid == 1)
            say(app, plain_line(packet.channel) +
                         ": a message that is no valid handle_list_t; more are only counted");
          return;
        }
        summary.add(*list);
        printer.print(*list);
      },
      kQueue);
  const auto limit =
      o.timeout_s > 0 ? std::optional(std::chrono::duration<double>(o.timeout_s)) : std::nullopt;
  const LoopEnd end = run_loop(bus, limit, [&] { return o.count > 0 && summary.answers() >= o.count; });
  if (invalid > 0)
    say(app, printed("%lld messages were no valid handle_list_t", static_cast<long long>(invalid)));
  if (o.summary) say_block(summary.str());
  if (end == LoopEnd::kTimeout && o.count > 0) {
    say(app, printed("%lld of %lld lists after %g s", static_cast<long long>(summary.answers()),
                     static_cast<long long>(o.count), o.timeout_s));
    return kExitFailed;
  }
  return exit_code(app, end, url);
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  using namespace graspd;
  CLI::App app("Shows handle lists as they arrive.", "graspd-listen");
  Options options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] { return listen(app, options); });
}
