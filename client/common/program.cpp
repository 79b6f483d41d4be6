// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/program.hpp"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "client/common/stop_flag.hpp"
#include "service/config/config_error.hpp"

namespace graspd {

int run_program(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help and --version
    say(app, std::string(error.what()) + " (see --help)");
    return kExitUsage;
  }
  catch_stop_signals();
  try {
    return body();
  } catch (const ConfigError& error) {
    say(app, error.what());
    return kExitUsage;
  } catch (const std::exception& error) {
    say(app, error.what());
    return kExitFailed;
  }
}

void add_version(CLI::App& app) {
  app.set_version_flag("--version", app.get_name() + " " GRASPD_VERSION);
}

void add_lcm_url(CLI::App& app, std::string& url) {
  app.add_option("-l,--lcm-url", url,
                 "LCM URL (default: LCM_DEFAULT_URL, else udpm://239.255.76.67:7667?ttl=0)");
}

void write_output(std::string_view text) {
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!written)
    throw std::runtime_error(std::string("standard output cannot be written: ") + std::strerror(errno));
}

void say(const CLI::App& app, std::string_view line) {
  std::fprintf(stderr, "%s: %.*s\n", app.get_name().c_str(), static_cast<int>(line.size()), line.data());
}

void say_block(std::string_view text) {
  std::fprintf(stderr, "%.*s", static_cast<int>(text.size()), text.data());
}

}  // namespace graspd
