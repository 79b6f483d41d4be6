// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A bar on a terminal: how far, how fast, how long still.
#pragma once
#include <chrono>
#include <cstdint>
#include <string>

namespace graspd {

class ProgressLine {
 public:
  /// Shows nothing where standard error is no terminal.
  ProgressLine();
  ~ProgressLine();  ///< Ends the line.
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// For a line of text to come.
  void clear();
  /// At most ten times a second. `frames` and `done` count from where the run has gone on.
  void show(std::int64_t frames, std::int64_t done, std::int64_t all);

 private:
  using Clock = std::chrono::steady_clock;
  bool terminal_;
  bool shown_ = false;
  std::int64_t first_frames_ = -1;
  std::int64_t first_done_ = 0;
  Clock::time_point start_;
  Clock::time_point next_;
};

/// "[=====>    ]  52 %, 1234 frames, 41.3 frames/s, 0:01:12 left"; the rates are over `seconds`.
[[nodiscard]] std::string progress_text(double share, std::int64_t frames, double frames_a_second,
                                        double seconds_left);

}  // namespace graspd
