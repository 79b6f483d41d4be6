// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-replay: handle lists for logs, faster than real time.
#include <CLI/CLI.hpp>

#include "client/common/program.hpp"
#include "client/replay/run_command.hpp"

int main(int argc, char** argv) {
  using namespace graspd;
  CLI::App app("Finds handles in LCM event logs as the daemon would, and writes them to an event log.",
               "graspd-replay");
  add_version(app);
  RunOptions options;
  add_run_options(app, options);
  return run_program(app, argc, argv, [&] { return run_command(app, options); });
}
