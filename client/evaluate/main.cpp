// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-evaluate: recall and precision of handles.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "client/common/program.hpp"
#include "client/evaluate/simulate_mode.hpp"
#include "service/config/service_config.hpp"

int main(int argc, char** argv) {
  using namespace graspd;
  CLI::App app("Recall and precision of handles.", "graspd-evaluate");
  SimulateOptions simulate;
  std::string config, gripper, format = "markdown";
  add_version(app);
  add_simulate_options(app, simulate);
  app.get_option("--simulate")->required();
  app.add_option("--config", config, "the daemon's configuration (default: its defaults)");
  app.add_option("--gripper", gripper, "name of an installed gripper, or a gripper file");
  app.add_option("-f,--format", format, "markdown, csv or json")
      ->check(CLI::IsMember({"markdown", "csv", "json"}));
  return run_program(app, argc, argv, [&] {
    const ServiceConfig service = config.empty() ? ServiceConfig() : load_service_config(config);
    SourceConfig source = service.sources.front();
    if (!gripper.empty()) source.gripper = find_gripper(gripper, std::filesystem::current_path());
    TableFormat written = TableFormat::kMarkdown;
    if (format == "csv") written = TableFormat::kCsv;
    if (format == "json") written = TableFormat::kJson;
    const auto tables = simulate_tables(simulate, source.gripper.gripper, source.detect);
    write_output(write_tables(tables, written));
    return int{kExitOk};
  });
}
