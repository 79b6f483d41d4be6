// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Text that takes the place of what was there on a terminal.
#pragma once
#include <string>
#include <string_view>

namespace graspd {

/// On a terminal each text replaces the last one in place; elsewhere texts follow each other.
class LiveText {
 public:
  LiveText();
  void show(std::string_view text);
  [[nodiscard]] bool on_terminal() const { return terminal_; }

 private:
  bool terminal_;
  bool first_ = true;
};

/// What LiveText writes to a terminal: from the upper left corner, without flicker.
[[nodiscard]] std::string redrawn(std::string_view text, bool first);

}  // namespace graspd
