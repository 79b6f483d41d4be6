// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-replay: handle lists for logs, faster than real time.
#include <CLI/CLI.hpp>
#include <map>
#include <string_view>

#include "client/common/program.hpp"
#include "client/replay/commands.hpp"
#include "client/replay/run_command.hpp"
#include "service/runtime/kept_memory.hpp"

namespace {

using Command = int (*)(int, char**);
const std::map<std::string_view, Command> kCommands{
    {"plan", graspd::plan_main},   {"shard", graspd::shard_main}, {"missing", graspd::missing_main},
    {"merge", graspd::merge_main}, {"table", graspd::table_main}, {"play", graspd::play_main}};

}  // namespace

int main(int argc, char** argv) {
  using namespace graspd;
  keep_memory();
  if (argc > 1)
    if (const auto command = kCommands.find(argv[1]); command != kCommands.end())
      return command->second(argc - 1, argv + 1);
  CLI::App app("Finds handles in LCM event logs as the daemon would, and writes them to an event log.",
               "graspd-replay");
  add_version(app);
  RunOptions options;
  add_run_options(app, options);
  app.footer(
      "Other commands, each with its own --help:\n"
      "  graspd-replay plan     splits logs into shards of equal work, for a cluster or GNU parallel\n"
      "  graspd-replay shard    works on one of them\n"
      "  graspd-replay missing  which are not done\n"
      "  graspd-replay merge    checks them and makes one log of them\n"
      "  graspd-replay table    handle lists of a log as Parquet tables\n"
      "  graspd-replay play     sends a log over LCM at its own speed, with pause and seek");
  return run_program(app, argc, argv, [&] { return run_command(app, options); });
}
