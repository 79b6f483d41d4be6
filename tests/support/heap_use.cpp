// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/heap_use.hpp"

#include <execinfo.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <memory>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define GRASPD_FOREIGN_MALLOC
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define GRASPD_FOREIGN_MALLOC
#endif

namespace graspd {
namespace {

struct Stack {
  std::array<void*, 24> frames;
  int depth;
};

constexpr std::size_t kMostStacks = 8;
std::array<Stack, kMostStacks> stacks_seen;
std::atomic<std::size_t> calls = 0;
std::atomic<bool> counting = false;

}  // namespace

bool heap_use_is_counted() {
#ifdef GRASPD_FOREIGN_MALLOC
  return false;
#else
  return true;
#endif
}

HeapUse::HeapUse() {
  Stack first{};
  backtrace(first.frames.data(), 1);  // loads a library, once
  calls = 0;
  counting = true;
}

HeapUse::~HeapUse() {
  counting = false;
}

std::size_t HeapUse::count() const {
  return calls;
}

std::string HeapUse::stacks() const {
  counting = false;
  std::string text;
  for (std::size_t k = 0; k < std::min<std::size_t>(calls, kMostStacks); ++k) {
    const Stack& stack = stacks_seen[k];
    const std::unique_ptr<char*, decltype(&std::free)> names(
        backtrace_symbols(stack.frames.data(), stack.depth), std::free);
    for (int i = 0; i < stack.depth; ++i) text += std::string(names.get()[i]) + '\n';
    text += '\n';
  }
  return text;
}

#ifndef GRASPD_FOREIGN_MALLOC
namespace {

void note() {
  if (!counting.load(std::memory_order_relaxed)) return;
  const std::size_t call = calls.fetch_add(1);
  if (call >= kMostStacks) return;
  Stack& stack = stacks_seen[call];
  stack.depth = backtrace(stack.frames.data(), static_cast<int>(stack.frames.size()));
}

}  // namespace
#endif

}  // namespace graspd

#ifndef GRASPD_FOREIGN_MALLOC
// In place of the C library's, for the whole process; these are the names under which it has its own.
extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t number, std::size_t size);
void* __libc_realloc(void* place, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* place);

void* malloc(std::size_t size) {
  graspd::note();
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  graspd::note();
  return __libc_calloc(number, size);
}
void* realloc(void* place, std::size_t size) {
  graspd::note();
  return __libc_realloc(place, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  graspd::note();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  graspd::note();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** place, std::size_t alignment, std::size_t size) {
  graspd::note();
  *place = __libc_memalign(alignment, size);
  return *place != nullptr ? 0 : ENOMEM;
}
void free(void* place) {
  __libc_free(place);
}
void* mmap(void* address, std::size_t size, int protection, int flags, int file, off_t offset) noexcept {
  graspd::note();
  // NOLINTNEXTLINE(performance-no-int-to-ptr): what the system call returns is an address
  return reinterpret_cast<void*>(syscall(SYS_mmap, address, size, protection, flags, file, offset));
}

}  // extern "C"
#endif
