// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <string_view>

#include "client/bridge/bridge_message.hpp"
#include "service/transport/control_codec.hpp"
#include "tests/fuzz/fuzzer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string why;
  auto control = graspd::parse_control({reinterpret_cast<const char*>(data), size}, why);
  graspd::require(control.has_value() == why.empty());
  if (!control) return 0;
  // Whatever a client sends, the daemon can read what goes out.
  control->id = 1;
  const auto read = graspd::decode_control(graspd::encode(*control));
  graspd::require(read && read->text == control->text && read->command == control->command);
  return 0;
}
