// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What every client program's main does: options, exit codes, output that must not get lost.
#pragma once
#include <functional>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace graspd {

enum ExitCode : int { kExitOk = 0, kExitFailed = 1, kExitUsage = 2 };

/// Reads the options, then calls the body; --help and --version end well. An exception becomes one line on
/// standard error: ConfigError ends with kExitUsage, any other with kExitFailed.
[[nodiscard]] int run_program(CLI::App& app, int argc, char** argv, const std::function<int()>& body);

/// Adds --version.
void add_version(CLI::App& app);

/// Adds -l/--lcm-url, as every program that talks LCM has it.
void add_lcm_url(CLI::App& app, std::string& url);

/// Writes to standard output and flushes; throws std::runtime_error when it cannot.
void write_output(std::string_view text);

/// One line on standard error, with the program's name.
void say(const CLI::App& app, std::string_view line);

/// Several lines on standard error, as they are.
void say_block(std::string_view text);

}  // namespace graspd
