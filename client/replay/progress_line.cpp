// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/progress_line.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "client/common/text.hpp"

namespace graspd {

std::string progress_text(double share, std::int64_t frames, double frames_a_second, double seconds_left) {
  constexpr int kWidth = 24;
  const int filled = std::clamp(static_cast<int>(share * kWidth), 0, kWidth);
  const std::string bar = std::string(static_cast<std::size_t>(filled), '=') +
                          std::string(static_cast<std::size_t>(kWidth - filled), ' ');
  const auto left = static_cast<long long>(std::clamp(seconds_left, 0.0, 3.6e8));
  return printed("[%s] %3.0f %%, %lld frames, %.1f frames/s, %lld:%02lld:%02lld left", bar.c_str(),
                 100 * share, static_cast<long long>(frames), frames_a_second, left / 3600, left / 60 % 60,
                 left % 60);
}

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0), start_(Clock::now()), next_(start_) {}

ProgressLine::~ProgressLine() {
  if (shown_) std::fputc('\n', stderr);
}

void ProgressLine::clear() {
  if (shown_) std::fputs("\r\x1b[K", stderr);
  shown_ = false;
}

void ProgressLine::show(std::int64_t frames, std::int64_t done, std::int64_t all) {
  if (!terminal_) return;
  if (first_frames_ < 0) {
    first_frames_ = frames;
    first_done_ = done;
  }
  const auto now = Clock::now();
  if (now < next_ && done < all) return;
  next_ = now + std::chrono::milliseconds(100);
  const double seconds = std::max(1e-3, std::chrono::duration<double>(now - start_).count());
  const double bytes_a_second = static_cast<double>(done - first_done_) / seconds;
  const double left = bytes_a_second > 0 ? static_cast<double>(all - done) / bytes_a_second : 0;
  const std::string text = progress_text(all > 0 ? static_cast<double>(done) / static_cast<double>(all) : 1,
                                         frames, static_cast<double>(frames - first_frames_) / seconds, left);
  std::fprintf(stderr, "\r%s\x1b[K", text.c_str());
  std::fflush(stderr);
  shown_ = true;
}

}  // namespace graspd
