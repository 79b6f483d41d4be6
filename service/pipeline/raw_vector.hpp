// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Large arrays that are written right after they are made: filling them with zeros first would cost as much.
#pragma once
#include <memory>
#include <memory_resource>
#include <new>
#include <utility>
#include <vector>

namespace graspd {

/// std::pmr::polymorphic_allocator, but what resize() adds is not initialised.
template <class T>
struct RawAllocator : std::pmr::polymorphic_allocator<T> {
  using std::pmr::polymorphic_allocator<T>::polymorphic_allocator;

  template <class U>
  struct rebind {
    using other = RawAllocator<U>;
  };
  template <class U>
  void construct(U* place) noexcept {
    ::new (static_cast<void*>(place)) U;
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    std::construct_at(place, std::forward<Arguments>(arguments)...);
  }
  [[nodiscard]] RawAllocator select_on_container_copy_construction() const { return {}; }
};

/// T: a type whose default initialisation does nothing.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace graspd
