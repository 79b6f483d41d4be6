// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/live_text.hpp"

#include <unistd.h>

#include "client/common/program.hpp"

namespace graspd {

std::string redrawn(std::string_view text, bool first) {
  // Home, each line cleared behind its end, the rest of the screen cleared: nothing blinks.
  std::string screen = first ? "\x1b[2J\x1b[H" : "\x1b[H";
  for (const char c : text) {
    if (c == '\n') screen += "\x1b[K";
    screen += c;
  }
  return screen + "\x1b[J";
}

LiveText::LiveText() : terminal_(isatty(STDOUT_FILENO) != 0) {}

void LiveText::show(std::string_view text) {
  write_output(terminal_ ? redrawn(text, first_) : std::string(text));
  first_ = false;
}

}  // namespace graspd
