// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/time_limit.hpp"

#include <pthread.h>
#include <signal.h>

namespace graspd {
namespace {

// One signal alone may come just before its thread begins to wait.
constexpr std::chrono::milliseconds kAgain{20};

/// A handler, so that the signal interrupts; without SA_RESTART, so that the call is not taken up again.
void take_signal() {
  struct sigaction action {};
  action.sa_handler = [](int) {};
  sigaction(SIGURG, &action, nullptr);
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGURG);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

}  // namespace

TimeLimit::TimeLimit(std::chrono::milliseconds limit) {
  take_signal();
  watch_ = std::thread([this, end = std::chrono::steady_clock::now() + limit, thread = pthread_self()] {
    interrupt(end, thread);
  });
}

TimeLimit::~TimeLimit() {
  {
    const std::scoped_lock lock(mutex_);
    over_ = true;
  }
  changed_.notify_one();
  watch_.join();
}

void TimeLimit::interrupt(std::chrono::steady_clock::time_point end, pthread_t thread) {
  std::unique_lock lock(mutex_);
  while (!changed_.wait_until(lock, end, [this] { return over_; })) {
    passed_ = true;
    pthread_kill(thread, SIGURG);
    end += kAgain;
  }
}

}  // namespace graspd
