// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Handle lists with every member set, for tests of what is written of them.
#pragma once
#include "graspd/handle_list_t.hpp"

namespace graspd {

/// Numbers are floats from a seed: awkward ones, such as tenths and thirds of small and large powers.
[[nodiscard]] handle_list_t sample_list(int num_handles, unsigned seed);

}  // namespace graspd
