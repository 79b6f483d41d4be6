// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd: clouds in over LCM, handle lists out.
#include <CLI/CLI.hpp>

#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "service/config/service_config.hpp"
#include "service/daemon/service_loop.hpp"
#include "service/daemon/version.hpp"
#include "service/runtime/kept_memory.hpp"

namespace {

using namespace graspd;

constexpr int kFailed = 1;
constexpr int kBadUsage = 2;
constexpr const char* kSystemConfig = "/etc/graspd/graspd.yaml";

struct Options {
  std::string config_file;
  std::string lcm_url;
  std::string gripper;
  std::optional<int> workers;
  std::optional<int> threads;
  bool check_config = false;
  bool print_config = false;
};

/// An exit code when the program ends here.
std::optional<int> parse(int argc, char** argv, Options& options) {
  CLI::App app{
      "Finds places where a two-finger gripper can hold something: point clouds in over LCM, handle lists "
      "out."};
  app.set_version_flag("--version", "graspd " + std::string(kVersion));
  app.add_option("-c,--config", options.config_file,
                 std::string("Service file; default: ") + kSystemConfig +
                     " where it exists, else the built-in defaults");
  app.add_flag("--check-config", options.check_config, "Only say whether the configuration can be used");
  app.add_flag("--print-config", options.print_config,
               "Only print the complete configuration, with every key's meaning");
  app.add_option(
      "-l,--lcm-url", options.lcm_url,
      "LCM URL; default: the configuration's, else LCM_DEFAULT_URL, else udpm://239.255.76.67:7667?ttl=0");
  app.add_option("--gripper", options.gripper, "Gripper for all sources: a name in grippers/ or a file");
  app.add_option("--workers", options.workers, "Frames in work at the same time at most")
      ->check(CLI::Range(1, 64));
  app.add_option("--threads", options.threads, "Threads a frame is split over at most; 0: one a core")
      ->check(CLI::Range(0, 256));
  app.footer("Exit code: 0 stopped as asked, 1 failed, 2 wrong usage or configuration.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : kBadUsage;
  }
  return std::nullopt;
}

/// The file that is read; empty: built-in defaults.
std::filesystem::path config_file(const Options& options) {
  if (!options.config_file.empty()) return options.config_file;
  std::error_code error;
  return std::filesystem::exists(kSystemConfig, error) ? kSystemConfig : "";
}

ConfigLayers layers_of(const Options& options) {
  return {config_file(options), options.workers, options.threads, options.lcm_url, options.gripper, {}};
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  if (const auto exit_code = parse(argc, argv, options)) return *exit_code;
  try {
    const ConfigLayers layers = layers_of(options);
    const ServiceConfig config = load_layers(layers);
    const std::string name = layers.file.empty() ? "built-in configuration" : layers.file.string();
    if (options.print_config) {
      std::cout << print(config) << std::flush;
      return std::cout ? 0 : kFailed;
    }
    if (options.check_config) {
      std::cerr << name << ": ok, " << config.sources.size() << " source(s)\n";
      return 0;
    }
    keep_memory();
    return serve(layers, config);
  } catch (const ConfigError& e) {
    std::cerr << e.what() << '\n';
    return kBadUsage;
  } catch (const std::exception& e) {
    std::cerr << "graspd: " << e.what() << '\n';
    return kFailed;
  }
}
