// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// graspd from its start to its end: bus, signals, systemd.
#pragma once
#include "service/config/service_config.hpp"

namespace graspd {

/// Serves until a signal, the end of a log file, or LCM is away for longer than allowed. The exit code.
/// Throws std::runtime_error for an LCM URL that can never work. `layers` is what `config` was loaded from.
[[nodiscard]] int serve(const ConfigLayers& layers, const ServiceConfig& config);

}  // namespace graspd
