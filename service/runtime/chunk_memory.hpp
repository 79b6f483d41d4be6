// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Large blocks out of larger chunks: what lies free side by side serves any size that fits, so that one
// frame's arrays can take the place of another's.
#pragma once
#include <cstddef>
#include <memory_resource>
#include <mutex>
#include <vector>

namespace graspd {

/// Blocks come from the lowest place where they fit. All functions may be called from any thread. Every block
/// must be back before the destructor.
class ChunkMemory {
 public:
  static constexpr std::size_t kAlignment = 64;
  static constexpr std::size_t kChunkBytes = std::size_t{8} << 20;  ///< or more, for a block that needs more

  explicit ChunkMemory(std::pmr::memory_resource* upstream) : upstream_(upstream) {}
  ~ChunkMemory() { give_back(0); }
  ChunkMemory(const ChunkMemory&) = delete;
  ChunkMemory& operator=(const ChunkMemory&) = delete;

  /// Aligned to kAlignment. Throws what upstream throws when there is no more.
  [[nodiscard]] void* allocate(std::size_t bytes);
  void deallocate(void* place, std::size_t bytes);

  /// Of all chunks.
  [[nodiscard]] std::size_t held_bytes() const;
  /// Of the chunks that had nothing in use since this was called before.
  [[nodiscard]] std::size_t look_for_idle();
  /// Returns chunks that have nothing in use and had nothing in the last `looks` calls of look_for_idle().
  void give_back(int looks);

 private:
  struct Chunk {
    std::byte* begin = nullptr;
    std::size_t bytes = 0;   ///< with kAlignment at the end that is never used: chunks do not touch
    std::size_t in_use = 0;  ///< bytes
    int idle_looks = 0;      ///< since something was in use
  };
  /// A free place.
  struct Gap {
    std::byte* begin = nullptr;
    std::size_t bytes = 0;
    [[nodiscard]] std::byte* end() const { return begin + bytes; }
  };

  std::size_t add_chunk(std::size_t bytes);
  Chunk& chunk_of(const std::byte* place);

  std::pmr::memory_resource* const upstream_;
  mutable std::mutex mutex_;
  std::vector<Chunk> chunks_;  // by address
  std::vector<Gap> gaps_;      // by address; neighbours do not touch
};

}  // namespace graspd
