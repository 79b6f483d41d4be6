// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The largest single allocation, to show that lying sizes are not allocated for.
#pragma once
#include <cstddef>

namespace graspd {

void forget_allocations();
/// [bytes] by operator new since forget_allocations(), in any thread.
[[nodiscard]] std::size_t largest_allocation();

}  // namespace graspd
