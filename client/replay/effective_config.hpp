// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A configuration as a text of its own: no installed gripper is needed to read it back.
#pragma once
#include <filesystem>
#include <string>

#include "service/config/service_config.hpp"

namespace graspd {

[[nodiscard]] std::string effective_config(ServiceConfig config);

/// The configuration of a daemon that is given these; all may be empty. `key_file` is its
/// authentication.key_file.
[[nodiscard]] ServiceConfig load_replay_config(const std::string& file, const std::string& gripper,
                                               const std::string& key_file);

}  // namespace graspd
