// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/chunk_memory.hpp"

#include <algorithm>
#include <iterator>

namespace graspd {
namespace {

constexpr std::size_t rounded(std::size_t bytes) {
  return (std::max<std::size_t>(bytes, 1) + ChunkMemory::kAlignment - 1) / ChunkMemory::kAlignment *
         ChunkMemory::kAlignment;
}

}  // namespace

void* ChunkMemory::allocate(std::size_t bytes) {
  bytes = rounded(bytes);
  const std::lock_guard lock(mutex_);
  const auto fits =
      std::find_if(gaps_.begin(), gaps_.end(), [=](const Gap& gap) { return gap.bytes >= bytes; });
  const std::size_t g =
      fits != gaps_.end() ? static_cast<std::size_t>(fits - gaps_.begin()) : add_chunk(bytes);
  std::byte* place = gaps_[g].begin;
  gaps_[g] = {place + bytes, gaps_[g].bytes - bytes};
  if (gaps_[g].bytes == 0) gaps_.erase(gaps_.begin() + static_cast<std::ptrdiff_t>(g));
  Chunk& chunk = chunk_of(place);
  chunk.in_use += bytes;
  chunk.idle_looks = 0;
  return place;
}

void ChunkMemory::deallocate(void* place, std::size_t bytes) {
  auto* const begin = static_cast<std::byte*>(place);
  const std::lock_guard lock(mutex_);
  chunk_of(begin).in_use -= rounded(bytes);
  Gap gap{begin, rounded(bytes)};
  const auto next = std::lower_bound(gaps_.begin(), gaps_.end(), begin,
                                     [](const Gap& g, const std::byte* b) { return g.begin < b; });
  const bool joins_next = next != gaps_.end() && gap.end() == next->begin;
  const bool joins_previous = next != gaps_.begin() && std::prev(next)->end() == begin;
  if (joins_previous) {
    std::prev(next)->bytes += gap.bytes + (joins_next ? next->bytes : 0);
    if (joins_next) gaps_.erase(next);
  } else if (joins_next) {
    *next = {begin, gap.bytes + next->bytes};
  } else {
    gaps_.insert(next, gap);
  }
}

std::size_t ChunkMemory::held_bytes() const {
  const std::lock_guard lock(mutex_);
  std::size_t sum = 0;
  for (const Chunk& chunk : chunks_) sum += chunk.bytes;
  return sum;
}

std::size_t ChunkMemory::look_for_idle() {
  const std::lock_guard lock(mutex_);
  std::size_t sum = 0;
  for (Chunk& chunk : chunks_) {
    if (chunk.in_use > 0) continue;
    if (chunk.idle_looks > 0) sum += chunk.bytes;
    ++chunk.idle_looks;
  }
  return sum;
}

void ChunkMemory::give_back(int looks) {
  const std::lock_guard lock(mutex_);
  std::erase_if(chunks_, [&](const Chunk& chunk) {
    if (chunk.in_use > 0 || chunk.idle_looks < looks) return false;
    std::erase_if(gaps_, [&](const Gap& gap) { return gap.begin == chunk.begin; });
    upstream_->deallocate(chunk.begin, chunk.bytes, kAlignment);
    return true;
  });
}

/// The number of its gap, which is all of it.
std::size_t ChunkMemory::add_chunk(std::size_t bytes) {
  const std::size_t whole = std::max(kChunkBytes, bytes + kAlignment);
  chunks_.reserve(chunks_.size() + 1);
  gaps_.reserve(std::max<std::size_t>(1024, gaps_.size() + 1));
  auto* const begin = static_cast<std::byte*>(upstream_->allocate(whole, kAlignment));
  const auto chunk =
      std::find_if(chunks_.begin(), chunks_.end(), [=](const Chunk& c) { return c.begin > begin; });
  chunks_.insert(chunk, {begin, whole, 0, 0});
  const auto gap = std::find_if(gaps_.begin(), gaps_.end(), [=](const Gap& g) { return g.begin > begin; });
  return static_cast<std::size_t>(gaps_.insert(gap, {begin, whole - kAlignment}) - gaps_.begin());
}

ChunkMemory::Chunk& ChunkMemory::chunk_of(const std::byte* place) {
  return *std::prev(
      std::find_if(chunks_.begin(), chunks_.end(), [=](const Chunk& c) { return c.begin > place; }));
}

}  // namespace graspd
