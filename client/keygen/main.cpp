// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd-keygen: makes a key that messages are signed with.
#include <CLI/CLI.hpp>
#include <string>

#include "client/common/program.hpp"
#include "service/transport/seal_keys.hpp"

int main(int argc, char** argv) {
  using namespace graspd;
  CLI::App app("Makes a key for signed messages: one line that only the file's owner can read.",
               "graspd-keygen");
  std::string file;
  add_version(app);
  app.add_option("file", file, "new file for the key")->required();
  return run_program(app, argc, argv, [&] {
    create_seal_key(file);
    return static_cast<int>(kExitOk);
  });
}
