// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// How much of the machine other programs leave.
#pragma once
#include <chrono>
#include <cstdint>
#include <string_view>
#include <vector>

namespace graspd {

/// What other processes leave of the cores that this one may run on. Not safe for threads.
class FreeCores {
 public:
  /// Between two looks lie at least so much; the kernel counts in hundredths of a second.
  static constexpr std::chrono::milliseconds kShortest{300};

  /// Begins to count. All cores are taken for free until there is a first figure.
  FreeCores();

  /// Cores' worth of time that others left since the look before, or before that one where that is too
  /// short a time; this process's own time counts as left. From 0 to the number of cores.
  [[nodiscard]] double look();

 private:
  struct Sample {
    std::chrono::steady_clock::time_point time;
    double busy_s = 0, own_s = 0;
  };
  [[nodiscard]] Sample sample() const;

  std::vector<int> cores_;
  Sample last_;
  double free_ = 0;
};

/// The numbers of the cores that this process may run on; empty where the kernel does not say.
[[nodiscard]] std::vector<int> usable_cores();

/// What the kernel's counts in /proc/stat add up to for these cores: all that is not idle, in the kernel's
/// ticks. with_niced: also what programs of lower priority (nice) take, which give way to one that is not
/// niced itself. Lines that are not there count nothing.
[[nodiscard]] std::int64_t busy_ticks(std::string_view stat_text, const std::vector<int>& cores,
                                      bool with_niced);

/// Threads that one frame gains by, from 1 to `most`. A helper on a core that others keep busy delays the
/// frame more than it helps: each stage waits for whatever it was interrupted in. Between the two limits it
/// stays at `now`.
[[nodiscard]] int threads_worth_having(double free_cores, int now, int most);

}  // namespace graspd
