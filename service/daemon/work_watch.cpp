// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/work_watch.hpp"

namespace graspd {

WorkWatch::Entry::Entry(WorkWatch& watch, const Job& job, Clock::TimePoint now) : watch_(watch) {
  const std::lock_guard lock(watch.mutex_);
  at_ = watch.works_.emplace(watch.works_.end());
  at_->job = &job;
  at_->begin = now;
  at_->cancelled = watch.all_cancelled_;
}

WorkWatch::Entry::~Entry() {
  const std::lock_guard lock(watch_.mutex_);
  watch_.works_.erase(at_);
}

int WorkWatch::look(Clock::TimePoint now, Clock::TimePoint::duration longest, const Answerer& late,
                    const Answerer& stuck) {
  const std::lock_guard lock(mutex_);
  int num_stuck = 0;
  for (Work& work : works_) {
    const auto deadline = work.job->processor->deadline(work.job->message);
    const bool too_long = longest > Clock::TimePoint::duration::zero() && now - work.begin > longest;
    num_stuck += too_long ? 1 : 0;
    if (too_long && !work.stuck) {
      work.stuck = true;
      work.cancelled = true;
      stuck(*work.job);
    } else if (deadline && now > *deadline && !work.late && !work.stuck) {
      work.late = true;
      work.cancelled = true;
      late(*work.job);
    }
  }
  return num_stuck;
}

void WorkWatch::give_up(const Stream& stream, const Answerer& answer) {
  const std::lock_guard lock(mutex_);
  for (Work& work : works_) {
    if (work.job->stream.get() != &stream) continue;
    work.cancelled = true;
    answer(*work.job);
  }
}

void WorkWatch::give_up_all(const Answerer& answer) {
  const std::lock_guard lock(mutex_);
  for (const Work& work : works_) answer(*work.job);
}

void WorkWatch::cancel_all() {
  const std::lock_guard lock(mutex_);
  all_cancelled_ = true;
  for (Work& work : works_) work.cancelled = true;
}

}  // namespace graspd
