// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Counts what a program and all its libraries take from the heap, and where.
#pragma once
#include <cstddef>
#include <string>

namespace graspd {

/// False under sanitizers, whose malloc cannot be replaced, and where the C library is not glibc.
[[nodiscard]] bool heap_use_is_counted();

/// What is taken by any thread while this lives: calls of malloc, calloc, realloc, posix_memalign,
/// aligned_alloc, memalign and mmap. One at a time.
class HeapUse {
 public:
  HeapUse();
  ~HeapUse();
  HeapUse(const HeapUse&) = delete;
  HeapUse& operator=(const HeapUse&) = delete;

  [[nodiscard]] std::size_t count() const;
  /// The call stacks of the first few, for people; what was counted stands still from then on.
  [[nodiscard]] std::string stacks() const;
};

}  // namespace graspd
