// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A service file's tree -> ServiceConfig, wherever the tree comes from.
#pragma once
#include <yaml-cpp/yaml.h>

#include "service/config/config_error.hpp"
#include "service/config/service_config.hpp"

namespace graspd {

/// As load_service_config(); `place` is the file that the tree is of, which names in it are relative to.
[[nodiscard]] ServiceConfig read_service_config(const YAML::Node& root, const ConfigPlace& place);

}  // namespace graspd
