// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What ThreadSanitizer leaves out; part of every program of a build with GRASPD_SANITIZE=thread, and of no
// other.

// Debian's libraries are not instrumented, so the sanitizer does not see what they order:
// - libtbb, a task before those that wait for it: every parallel loop would be reported;
// - GLib's locks, by which memq:// hands a message's bytes to the reader. race_top: only what touches those
// bytes itself,
//   not what a handler does with them.
// - libOpenNI2, which PCL's readers of files bring along: unlocks mutexes that it has destroyed as it ends.
// Mailboxes, gates, counts and log stay checked.
extern "C" const char*
__tsan_default_suppressions() {  // NOLINT(clang-diagnostic-reserved-identifier): the sanitizer's name
  return "race:libtbb.so\n"
         "called_from_lib:libglib-2.0.so\n"
         "called_from_lib:liblcm.so\n"
         "race_top:LcmBus::Subscription::dispatch\n"
         "race_top:graspd::ByteReader\n"
         "race_top:memchr\n"
         "mutex:libOpenNI2.so\n";
}
