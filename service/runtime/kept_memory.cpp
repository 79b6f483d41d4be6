// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/kept_memory.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <new>
#include <utility>

namespace graspd {

KeptMemory::KeptMemory(std::pmr::memory_resource* upstream) : upstream_(upstream), chunks_(upstream) {}

KeptMemory::~KeptMemory() {
  give_back();
}

void KeptMemory::give_back() {
  for (std::size_t list = 0; list < kNumLists; ++list)
    give_back(list, std::numeric_limits<std::uint32_t>::max());
  chunks_.give_back(0);
}

/// The sizes of an octave are 5, 6, 7 and 8 eighths of kSmallest << octave.
std::size_t KeptMemory::list_of(std::size_t bytes) {
  const std::size_t last = std::max(bytes, kSmallest) - 1;
  const auto octave = static_cast<std::size_t>(std::bit_width(last / kSmallest));
  const std::size_t eighth = kSmallest / 8 << octave;
  return octave == 0 ? 0 : 4 * octave - 7 + last / eighth;
}

std::size_t KeptMemory::block_bytes(std::size_t list) {
  if (list == 0) return kSmallest;
  const std::size_t octave = (list + 3) / 4;
  return (kSmallest / 8 << octave) * (list + 8 - 4 * octave);
}

bool KeptMemory::is_kept(std::size_t bytes, std::size_t alignment) {
  return bytes <= kLargestKept && alignment <= kAlignment;
}

void* KeptMemory::do_allocate(std::size_t bytes, std::size_t alignment) {
  if (!is_kept(bytes, alignment)) return upstream_->allocate(bytes, alignment);
  if (num_allocations_.fetch_add(1, std::memory_order_relaxed) % kLookEvery == kLookEvery - 1) look();
  if (bytes > kLargestListed) return chunks_.allocate(bytes);
  const std::size_t number = list_of(bytes);
  List& list = lists_[number];
  {
    const std::lock_guard lock(list.mutex);
    if (list.free != nullptr) {
      list.least_free = std::min(list.least_free, --list.num_free);
      return std::exchange(list.free, list.free->next);
    }
    list.least_free = 0;
  }
  void* place = upstream_->allocate(block_bytes(number), kAlignment);
  listed_bytes_.fetch_add(block_bytes(number), std::memory_order_relaxed);
  return place;
}

void KeptMemory::do_deallocate(void* place, std::size_t bytes, std::size_t alignment) {
  if (!is_kept(bytes, alignment)) return upstream_->deallocate(place, bytes, alignment);
  if (bytes > kLargestListed) return chunks_.deallocate(place, bytes);
  List& list = lists_[list_of(bytes)];
  const std::lock_guard lock(list.mutex);
  list.free = ::new (place) Block{list.free};
  ++list.num_free;
}

bool KeptMemory::do_is_equal(const memory_resource& other) const noexcept {
  return this == &other;
}

void KeptMemory::look() {
  std::array<std::uint32_t, kNumLists> spare{};
  std::size_t spare_bytes = chunks_.look_for_idle();
  for (std::size_t number = 0; number < kNumLists; ++number) {
    List& list = lists_[number];
    const std::lock_guard lock(list.mutex);
    spare[number] = std::exchange(list.least_free, list.num_free);
    spare_bytes += spare[number] * block_bytes(number);
  }
  if (spare_bytes <= held_bytes() / 2) return;
  for (std::size_t number = 0; number < kNumLists; ++number) give_back(number, spare[number]);
  chunks_.give_back(2);
}

void KeptMemory::give_back(std::size_t number, std::uint32_t at_most) {
  List& list = lists_[number];
  const std::lock_guard lock(list.mutex);
  for (; at_most > 0 && list.free != nullptr; --at_most) {
    Block* block = std::exchange(list.free, list.free->next);
    upstream_->deallocate(block, block_bytes(number), kAlignment);
    listed_bytes_.fetch_sub(block_bytes(number), std::memory_order_relaxed);
    --list.num_free;
  }
  list.least_free = std::min(list.least_free, list.num_free);
}

KeptMemory& keep_memory() {
  // Never destroyed: what has static storage may give memory back after main().
  static KeptMemory* const memory = new KeptMemory;
  std::pmr::set_default_resource(memory);
  return *memory;
}

}  // namespace graspd
