// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Pieces of work beside each other, each of which is done whatever the others throw.
#pragma once
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <exception>
#include <tuple>

namespace graspd {

template <class Work>
struct GuardedWork {
  const Work& work;
  std::exception_ptr& thrown;

  void operator()() const {
    try {
      work();
    } catch (...) {
      thrown = std::current_exception();
    }
  }
};

/// Does all of them on the threads that are free, then throws what the first one of those that threw did.
/// When one throws, tbb::parallel_invoke() alone would cancel the loops of the others, which then go on with
/// what these have left undone.
template <class... Work>
void run_beside(const Work&... work) {
  std::array<std::exception_ptr, sizeof...(Work)> thrown;
  auto next = thrown.begin();
  const std::tuple guarded{GuardedWork<Work>{work, *next++}...};
  std::apply([](const auto&... each) { tbb::parallel_invoke(each...); }, guarded);
  const auto first = std::find_if(thrown.begin(), thrown.end(), [](const auto& e) { return e != nullptr; });
  if (first != thrown.end()) std::rethrow_exception(*first);
}

}  // namespace graspd
