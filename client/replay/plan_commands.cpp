// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdlib>
#include <string_view>

#include "client/common/program.hpp"
#include "client/common/text.hpp"
#include "client/log/log_parts.hpp"
#include "client/replay/commands.hpp"
#include "client/replay/effective_config.hpp"
#include "client/replay/merge.hpp"
#include "client/replay/replay_run.hpp"
#include "client/replay/run_command.hpp"
#include "client/table/handle_tables.hpp"
#include "service/config/config_error.hpp"

namespace graspd {
namespace {

/// The number that Slurm or Kubernetes gives to a task of an array.
std::size_t shard_of_environment() {
  for (const char* name : {"SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX"}) {
    const char* value = std::getenv(name);
    if (value == nullptr) continue;
    const std::string_view text(value);
    std::size_t shard = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), shard);
    if (error == std::errc{} && end == text.data() + text.size()) return shard;
    throw ConfigError(std::string(name) + ": got " + value + ", expected the number of a shard");
  }
  throw ConfigError("which shard? neither given, nor in SLURM_ARRAY_TASK_ID or JOB_COMPLETION_INDEX");
}

int work_on_shard(const CLI::App& app, const std::string& folder, std::size_t shard, int threads) {
  const Plan plan = load_plan(folder);
  if (shard >= plan.shards.size())
    throw ConfigError(printed("shard %zu: the plan has %zu, from 0", shard, plan.shards.size()));
  ReplayConfig config = shard_config(folder, plan, shard);
  config.threads = replay_threads(threads);
  const auto receipt = replay_to(app, config, shard_log(folder, shard), OldOutput::kResume);
  if (!receipt) return kExitFailed;
  if (receipt->state.frames == plan.shards[shard].frames) return kExitOk;
  say(app, printed("shard %zu: %lld frames, %lld were planned", shard,
                   static_cast<long long>(receipt->state.frames),
                   static_cast<long long>(plan.shards[shard].frames)));
  return kExitFailed;
}

}  // namespace

int plan_main(int argc, char** argv) {
  CLI::App app("Splits logs into shards of equal work.", "graspd-replay plan");
  std::vector<std::string> logs;
  std::string folder, config, gripper, key_file, keep;
  std::size_t shards = 1;
  app.add_option("logs", logs, "event logs, as for graspd-replay")->required();
  app.add_option("-o,--output", folder, "folder for the plan and the shards' outputs")->required();
  app.add_option("--shards", shards, "how many")->check(CLI::Range(1, 1'000'000))->capture_default_str();
  app.add_option("--config", config, "the daemon's configuration (default: its defaults)");
  app.add_option("--gripper", gripper, "name of an installed gripper, or a gripper file, for all sources");
  app.add_option("--key", key_file, "opens signed clouds; every task needs the file, which is not copied");
  app.add_option("--keep", keep, "original channels that go into the output too");
  return run_program(app, argc, argv, [&] {
    const ServiceConfig service = load_replay_config(config, gripper, key_file);
    const Plan plan = make_plan(list_logs(logs), service, keep, shards);
    save_plan(folder, plan, service);
    say(app, printed("%zu shards, %lld frames in %zu logs", plan.shards.size(),
                     static_cast<long long>(plan.frames), plan.logs.size()));
    write_output(printed("%zu\n", plan.shards.size()));
    return kExitOk;
  });
}

int shard_main(int argc, char** argv) {
  CLI::App app(
      "Works on one shard of a plan; does nothing when it is done already, goes on when it was stopped.",
      "graspd-replay shard");
  std::string folder;
  std::optional<std::size_t> shard;
  int threads = 0;
  app.add_option("folder", folder, "of the plan")->required();
  app.add_option("shard", shard, "from 0 (default: SLURM_ARRAY_TASK_ID, else JOB_COMPLETION_INDEX)");
  app.add_option("--threads", threads, "frames in work at the same time; 0: one a core")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  return run_program(app, argc, argv, [&] {
    return work_on_shard(app, folder, shard ? *shard : shard_of_environment(), threads);
  });
}

int missing_main(int argc, char** argv) {
  CLI::App app("Prints the shards that are not done, as sbatch --array takes them; nothing: all are.",
               "graspd-replay missing");
  std::string folder;
  app.add_option("folder", folder, "of the plan")->required();
  return run_program(app, argc, argv, [&] {
    std::string text;
    for (const std::size_t shard : missing_shards(folder, load_plan(folder)))
      text += (text.empty() ? "" : ",") + std::to_string(shard);
    write_output(text.empty() ? "" : text + '\n');
    return kExitOk;
  });
}

int merge_main(int argc, char** argv) {
  CLI::App app("Checks the shards' outputs and makes one log of them, the same as a run over all logs.",
               "graspd-replay merge");
  std::string folder, output, table;
  bool overwrite = false;
  app.add_option("folder", folder, "of the plan")->required();
  app.add_option("-o,--output", output, "event log of the handle lists")->required();
  app.add_option("--table", table, "FILE.parquet: the handles; FILE.frames.parquet: the frames");
  app.add_flag("--overwrite", overwrite, "replace an output that exists");
  return run_program(app, argc, argv, [&] {
    const Plan plan = load_plan(folder);
    const Receipt receipt =
        merge_shards(folder, plan, output, overwrite ? OldOutput::kOverwrite : OldOutput::kRefuse);
    say(app, printed("%zu shards, %lld frames: %s; sha256 %s", plan.shards.size(),
                     static_cast<long long>(receipt.state.frames), answers_text(receipt.state).c_str(),
                     receipt.sha256.c_str()));
    if (!table.empty()) (void)write_tables(output, table);
    return kExitOk;
  });
}

int table_main(int argc, char** argv) {
  CLI::App app("Writes the handle lists of a log, of whatever program, as tables.", "graspd-replay table");
  std::string log, table;
  app.add_option("log", log, "event log with handle lists")->required();
  app.add_option("-o,--output", table, "FILE.parquet: the handles; FILE.frames.parquet: the frames")
      ->required();
  return run_program(app, argc, argv, [&] {
    say(app, printed("%lld frames", static_cast<long long>(write_tables(log, table))));
    return kExitOk;
  });
}

}  // namespace graspd
