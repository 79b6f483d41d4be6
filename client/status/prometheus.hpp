// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A daemon's status for Prometheus: the node exporter's textfile collector reads it from a file.
#pragma once
#include <string>

#include "graspd/status_t.hpp"

namespace graspd {

/// Families with HELP and TYPE, counters ending in _total, units in names; ends with a newline.
[[nodiscard]] std::string prometheus_text(const status_t& status);

/// The same when no daemon is heard: graspd_up is 0 and nothing else is known.
[[nodiscard]] std::string prometheus_down();

}  // namespace graspd
