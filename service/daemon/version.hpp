// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The project's version, from CMake.
#pragma once
#include <string_view>

namespace graspd {
inline constexpr std::string_view kVersion = GRASPD_VERSION;
}  // namespace graspd
