# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""The daemon under valgrind: clouds, images, nonsense, a reload and the end; no error, nothing lost. Takes minutes: by hand."""
import pathlib
import shutil
import signal

from trial import BIN, CLOUDS, HANDLES, STATUS, TYPES, Trial, options_of, run_trial, table, wait_until

OPTIONS = options_of(__doc__, frames=2, width=160)
CONFIG = "sources: [{name: camera, channel: GRASPD_CLOUD, policy: all}]\n"
VALGRIND = ["--error-exitcode=99", "--leak-check=full", "--errors-for-leak-kinds=definite", "--show-leak-kinds=definite",
            "--num-callers=20", "--quiet", f"--suppressions={pathlib.Path(__file__).resolve().parent}/valgrind.supp"]


class Memcheck(Trial):
    def note(self, channel, data):
        kind = "status_t" if channel == STATUS else "handle_list_t"
        self.seen[channel].append(TYPES[kind].decode(data))

    def test_memcheck(self):
        valgrind = shutil.which("valgrind")
        if valgrind is None:
            self.skipTest("valgrind is missing")
        frames = self.record_frames(OPTIONS.frames, kind="cloud", width=OPTIONS.width)
        frames += self.record_frames(OPTIONS.frames, kind="depth", width=OPTIONS.width)
        self.seen = {HANDLES: [], STATUS: []}
        listener = self.listen(self.note, set(self.seen))
        # An absolute path is taken as it is.
        daemon = self.start(valgrind, *VALGRIND, BIN / "graspd", "--config", self.write_config(CONFIG))
        wait_until(lambda: (listener.receive(0.05), self.seen[STATUS] or daemon.process.poll() is not None)[1], "status", 300)
        messages = [self.with_seq(frame, n) for n, frame in enumerate(frames)]
        messages += [b"", b"nonsense", messages[0][:-7], messages[0] + b"\0"]
        for number, message in enumerate(messages):
            self.send_paced(listener, CLOUDS, message)
            wait_until(lambda n=number: (listener.receive(0.05), len(self.seen[HANDLES]) > n)[1], "an answer", 600)
        daemon.process.send_signal(signal.SIGHUP)
        wait_until(lambda: (listener.receive(0.05), self.seen[STATUS][-1].config_revision > 1)[1], "the reload", 300)
        code, seconds = daemon.stop()
        errors = daemon.err.count("\n==") if code == 99 else 0
        table(("trial", "memcheck"), ("frames", len(frames)), ("answers", len(self.seen[HANDLES])),
              ("handles", sum(a.num_handles for a in self.seen[HANDLES])), ("lines of valgrind", errors),
              ("exit code", code), ("stop [s]", f"{seconds:.1f}"))
        self.assertNotIn(" at 0x", daemon.err)
        # Under valgrind the end may take longer than a frame is waited for.
        self.assertNotEqual(code, 99, daemon.err[-6000:])


if __name__ == "__main__":
    run_trial()
