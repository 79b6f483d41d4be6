// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <string_view>

#include "client/view/commands.hpp"
#include "client/view/settings.hpp"
#include "service/config/service_config.hpp"
#include "tests/fuzz/fuzzer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const graspd::Settings settings("");
  const auto command = graspd::parse_command({reinterpret_cast<const char*>(data), size});
  if (!command) return 0;
  const auto* set = std::get_if<graspd::SetCommand>(&*command);
  // Whatever a page sends, the daemon gets YAML with one source and nothing else.
  if (set != nullptr && !settings.problem(*set)) (void)graspd::merge_overrides("", settings.yaml(*set));
  return 0;
}
