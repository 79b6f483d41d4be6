// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A daemon's status for people, and as JSON.
#pragma once
#include <string>

#include "graspd/status_t.hpp"

namespace graspd {

/// A line for the daemon and a table of its sources.
[[nodiscard]] std::string status_text(const status_t& status);

/// Everything in it, in one line, under the names of the wire type; no newline.
[[nodiscard]] std::string status_json(const status_t& status);

}  // namespace graspd
