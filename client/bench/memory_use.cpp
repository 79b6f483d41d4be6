// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/bench/memory_use.hpp"

#include <malloc.h>

#include <fstream>
#include <memory_resource>

#include "service/runtime/kept_memory.hpp"

namespace graspd {
namespace {

bool reset_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return static_cast<bool>(file);
}

/// Where std::pmr's containers have their memory from for as long as this lives.
class FreshMemory {
 public:
  FreshMemory() : usual_(std::pmr::set_default_resource(&memory_)) {}
  ~FreshMemory() { std::pmr::set_default_resource(usual_); }
  FreshMemory(const FreshMemory&) = delete;
  FreshMemory& operator=(const FreshMemory&) = delete;

 private:
  KeptMemory memory_;
  std::pmr::memory_resource* const usual_;
};

}  // namespace

std::optional<std::int64_t> status_bytes(const std::string& process, const std::string& key) {
  std::ifstream file("/proc/" + process + "/status");
  for (std::string word; file >> word;) {
    std::int64_t kib = 0;
    if (word == key && file >> kib) return 1024 * kib;
  }
  return std::nullopt;
}

std::optional<std::int64_t> peak_growth_bytes(const std::function<void()>& body) {
  malloc_trim(0);
  if (!reset_peak()) return std::nullopt;
  const auto before = status_bytes("self", "VmRSS:");
  {
    const FreshMemory nothing_kept;
    body();
  }
  const auto peak = status_bytes("self", "VmHWM:");
  if (!before || !peak) return std::nullopt;
  return *peak - *before;
}

}  // namespace graspd
