// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Memory that one frame leaves to the next, so that frames need none from the system.
#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <mutex>

#include "service/runtime/chunk_memory.hpp"

namespace graspd {

/// Keeps what is freed and hands it out again: up to kLargestListed bytes in lists by size, four sizes an
/// octave, more in chunks. Blocks of more than kLargestKept bytes, or aligned to more than kAlignment, come
/// from upstream and go back there at once. Now and then it looks at what nobody has needed since it looked
/// before; when that is more than half of everything, a far larger frame has gone by, and it goes back
/// upstream. All functions may be called from any thread. Everything must be freed before the destructor.
class KeptMemory final : public std::pmr::memory_resource {
 public:
  static constexpr std::size_t kAlignment = 64;
  static constexpr std::size_t kLargestListed = 4096;
  static constexpr std::size_t kLargestKept = std::size_t{64} << 20;
  /// Allocations from one look to the next: some fifty frames.
  static constexpr std::uint32_t kLookEvery = 1 << 15;

  explicit KeptMemory(std::pmr::memory_resource* upstream = std::pmr::new_delete_resource());
  ~KeptMemory() override;
  KeptMemory(const KeptMemory&) = delete;
  KeptMemory& operator=(const KeptMemory&) = delete;

  /// Returns all that is not in use.
  void give_back();

  /// In use and kept, without what goes past the lists.
  [[nodiscard]] std::size_t held_bytes() const { return listed_bytes_ + chunks_.held_bytes(); }

 private:
  struct Block {
    Block* next;
  };
  /// Blocks of one size. On a cache line of its own, because each thread has sizes of its own.
  struct alignas(kAlignment) List {
    std::mutex mutex;
    Block* free = nullptr;
    std::uint32_t num_free = 0;
    std::uint32_t least_free = 0;  ///< since the last look
  };
  static constexpr std::size_t kSmallest = 64;
  static constexpr std::size_t kNumLists = 4 * 6 + 1;

  static std::size_t list_of(std::size_t bytes);
  static std::size_t block_bytes(std::size_t list);
  static bool is_kept(std::size_t bytes, std::size_t alignment);

  void* do_allocate(std::size_t bytes, std::size_t alignment) override;
  void do_deallocate(void* place, std::size_t bytes, std::size_t alignment) override;
  [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override;

  void look();
  void give_back(std::size_t list, std::uint32_t at_most);

  std::pmr::memory_resource* const upstream_;
  ChunkMemory chunks_;
  std::array<List, kNumLists> lists_;
  std::atomic<std::size_t> listed_bytes_ = 0;
  std::atomic<std::uint32_t> num_allocations_ = 0;
};

/// Makes all memory of std::pmr's containers come from one KeptMemory, which lives as long as the process.
/// Before the first of them, and before the first thread starts. The same again, when called again.
KeptMemory& keep_memory();

}  // namespace graspd
