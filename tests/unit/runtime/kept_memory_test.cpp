// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/runtime/kept_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <mutex>
#include <new>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace graspd {
namespace {

/// Counts what is taken and given back, and knows the size of each block.
class Upstream final : public std::pmr::memory_resource {
 public:
  ~Upstream() override { EXPECT_TRUE(blocks_.empty()) << blocks_.size() << " blocks are lost"; }

  [[nodiscard]] int taken() const { return taken_; }
  [[nodiscard]] std::size_t held() const { return held_; }
  void fail_from_now_on() { fails_ = true; }

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    const std::lock_guard lock(mutex_);
    if (fails_) throw std::bad_alloc();
    void* place = std::pmr::new_delete_resource()->allocate(bytes, alignment);
    blocks_[place] = bytes;
    held_ += bytes;
    ++taken_;
    return place;
  }
  void do_deallocate(void* place, std::size_t bytes, std::size_t alignment) override {
    const std::lock_guard lock(mutex_);
    EXPECT_EQ(blocks_.at(place), bytes);
    blocks_.erase(place);
    held_ -= bytes;
    std::pmr::new_delete_resource()->deallocate(place, bytes, alignment);
  }
  [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override {
    return this == &other;
  }

  std::mutex mutex_;
  std::map<void*, std::size_t> blocks_;
  std::size_t held_ = 0;
  int taken_ = 0;
  bool fails_ = false;
};

/// Takes blocks of these sizes, writes to every byte, and gives them back in another order.
void use(std::pmr::memory_resource& memory, const std::vector<std::size_t>& sizes) {
  std::vector<std::pair<void*, std::size_t>> blocks;
  for (const std::size_t size : sizes) {
    blocks.emplace_back(memory.allocate(size, 16), size);
    std::memset(blocks.back().first, static_cast<int>(blocks.size()), size);
  }
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const auto* bytes = static_cast<const unsigned char*>(blocks[k].first);
    if (blocks[k].second == 0) continue;
    EXPECT_EQ(bytes[0], static_cast<unsigned char>(k + 1));
    // All bytes equal the one after: one call, which sanitizers look at as a whole.
    EXPECT_EQ(std::memcmp(bytes, bytes + 1, blocks[k].second - 1), 0);
  }
  std::reverse(blocks.begin(), blocks.begin() + static_cast<std::ptrdiff_t>(blocks.size() / 2));
  for (const auto& [place, size] : blocks) memory.deallocate(place, size, 16);
}

TEST(KeptMemory, NothingIsTakenTwice) {
  Upstream upstream;
  KeptMemory memory(&upstream);
  const std::vector<std::size_t> sizes{1, 1, 0, 64, 65, 80, 1000, 1000, 4096, 100'000, 1 << 20};
  use(memory, sizes);
  const int taken = upstream.taken();
  EXPECT_EQ(taken, 9 + 1);  // all above 4096 bytes from one chunk
  EXPECT_EQ(memory.held_bytes(), upstream.held());
  for (int frame = 0; frame < 10; ++frame) use(memory, sizes);
  EXPECT_EQ(upstream.taken(), taken);
}

TEST(KeptMemory, BlocksAreLargeEnoughAlignedAndNotMuchLarger) {
  Upstream upstream;
  KeptMemory memory(&upstream);
  std::vector<std::size_t> sizes;
  for (std::size_t size = 1; size < 3000; ++size) sizes.push_back(size);
  sizes.insert(sizes.end(), {4095, 4096});
  for (const std::size_t size : sizes) {
    const std::size_t before = upstream.held();
    void* place = memory.allocate(size, KeptMemory::kAlignment);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(place) % KeptMemory::kAlignment, 0u);
    const std::size_t grown = upstream.held() - before;
    EXPECT_GE(grown, size);
    EXPECT_LE(grown, std::max<std::size_t>(64, size + size / 4));
    memory.deallocate(place, size, KeptMemory::kAlignment);
    memory.give_back();
    EXPECT_EQ(upstream.held(), 0u);
  }
}

TEST(KeptMemory, LargeBlocksShareWhatLiesFreeSideBySide) {
  Upstream upstream;
  KeptMemory memory(&upstream);
  constexpr std::size_t kPart = 1 << 20;
  std::vector<void*> parts;
  for (int i = 0; i < 7; ++i) parts.push_back(memory.allocate(kPart, KeptMemory::kAlignment));
  for (void* part : parts) EXPECT_EQ(reinterpret_cast<std::uintptr_t>(part) % KeptMemory::kAlignment, 0u);
  EXPECT_EQ(upstream.taken(), 1);
  for (const std::size_t i : {1u, 5u, 3u, 2u, 4u}) memory.deallocate(parts[i], kPart, 64);
  void* five = memory.allocate(5 * kPart, 64);
  EXPECT_EQ(five, parts[1]);
  EXPECT_EQ(upstream.taken(), 1);
  memory.deallocate(parts[0], kPart, 64);
  void* first = memory.allocate(kPart - 100, 64);
  EXPECT_EQ(first, parts[0]);
  memory.deallocate(first, kPart - 100, 64);
  memory.deallocate(five, 5 * kPart, 64);
  memory.deallocate(parts[6], kPart, 64);
  memory.give_back();
  EXPECT_EQ(upstream.held(), 0u);
}

TEST(KeptMemory, LargeBlocksInAnyOrderKeepTheirBytes) {
  Upstream upstream;
  KeptMemory memory(&upstream);
  std::minstd_rand random(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::size_t> sizes(random() % 40);
    for (std::size_t& size : sizes) size = random() % (random() % 3 == 0 ? 3'000'000 : 30'000);
    use(memory, sizes);
  }
  memory.give_back();
  EXPECT_EQ(upstream.held(), 0u);
}

TEST(KeptMemory, WhatIsTooLargeOrTooWellAlignedGoesBackAtOnce) {
  Upstream upstream;
  KeptMemory memory(&upstream);
  void* large = memory.allocate(KeptMemory::kLargestKept + 1, 8);
  void* aligned = memory.allocate(100, 4096);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(aligned) % 4096, 0u);
  memory.deallocate(large, KeptMemory::kLargestKept + 1, 8);
  memory.deallocate(aligned, 100, 4096);
  EXPECT_EQ(upstream.held(), 0u);
  EXPECT_EQ(memory.held_bytes(), 0u);
}

TEST(KeptMemory, AFarLargerFrameIsForgotten) {
  Upstream upstream;
  KeptMemory memory(&upstream);
  const std::vector<std::size_t> usual{1000, 50'000, 50'000};
  use(memory, usual);
  use(memory, {1 << 23, 1 << 23, 1 << 24});
  use(memory, std::vector<std::size_t>(1000, 3000));
  const std::size_t large_bytes = upstream.held();
  EXPECT_GT(large_bytes, std::size_t{5} << 23);
  for (std::uint32_t k = 0; k < 3 * KeptMemory::kLookEvery; k += 3) use(memory, usual);
  EXPECT_LT(upstream.held(), large_bytes / 2);
  EXPECT_EQ(memory.held_bytes(), upstream.held());
}

TEST(KeptMemory, SmallerFramesInBetweenCostNothing) {
  Upstream upstream;
  KeptMemory memory(&upstream);
  const std::vector<std::size_t> large{1 << 23, 1 << 23}, small{1000, 2000};
  use(memory, large);
  use(memory, small);
  const int taken = upstream.taken();
  for (std::uint32_t k = 0; k < 3 * KeptMemory::kLookEvery; k += 100) {
    for (int i = 0; i < 49; ++i) use(memory, small);
    use(memory, large);
  }
  EXPECT_EQ(upstream.taken(), taken);
}

TEST(KeptMemory, OutOfMemoryIsTold) {
  Upstream upstream;
  KeptMemory memory(&upstream);
  void* place = memory.allocate(100, 8);
  upstream.fail_from_now_on();
  EXPECT_THROW((void)memory.allocate(100, 8), std::bad_alloc);
  memory.deallocate(place, 100, 8);
  EXPECT_EQ(memory.allocate(100, 8), place);
  memory.deallocate(place, 100, 8);
}

/// Blocks go from thread to thread: each frees what another one took.
TEST(KeptMemory, ThreadsShareIt) {
  Upstream upstream;
  KeptMemory memory(&upstream);
  std::mutex mutex;
  std::vector<std::pmr::string> shared;
  const auto work = [&](unsigned seed) {
    std::minstd_rand random(seed);
    for (int i = 0; i < 20'000; ++i) {
      std::pmr::string text(random() % 3000, static_cast<char>('a' + seed), &memory);
      const std::lock_guard lock(mutex);
      if (shared.size() < 50) {
        shared.push_back(std::move(text));
        continue;
      }
      std::swap(shared[random() % shared.size()], text);
      EXPECT_EQ(text.find_first_not_of(text.empty() ? 'a' : text[0]), std::string::npos);
    }
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned seed = 0; seed < 4; ++seed) threads.emplace_back(work, seed);
  }
  shared.clear();
  memory.give_back();
  EXPECT_EQ(upstream.held(), 0u);
}

}  // namespace
}  // namespace graspd
