// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Part of every program of a build with GRASPD_SANITIZE=thread, and of no other: a frame has one thread
// there. Debian's libtbb is not instrumented, so ThreadSanitizer does not see that it orders a task before
// those who wait for it: what a parallel loop finds is no finding, and leaving it out takes minutes a frame.
// Workers, gates, mailboxes, log and bus run side by side as ever.
#include <tbb/global_control.h>

namespace {

const tbb::global_control one_thread_a_frame(tbb::global_control::max_allowed_parallelism, 1);

}  // namespace
