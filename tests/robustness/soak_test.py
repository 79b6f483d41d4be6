# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""One camera for a long time: every frame is answered, in order, and nothing grows."""
import statistics
import time

from trial import (CLOUDS, HANDLES, LIST, PROCESSED, STATUS, TYPES, Camera, Process, Trial, options_of, percentile, run_trial,
                   table, wait_until)

OPTIONS = options_of(__doc__, seconds=10.0, rate=10.0, kind="depth", width=320, warm_up=3.0)
CONFIG = "sources: [{name: camera, channel: GRASPD_CLOUD, policy: latest}]\n"
LONG_S = 300  # from here on memory must have settled
FEWEST = 10  # frames worked on before the first look at memory, and after it, however long that takes


class Soak(Trial):
    def note(self, channel, data):
        if channel == STATUS:
            self.status = TYPES["status_t"].decode(data)
            return
        answer = TYPES["handle_list_t"].decode(data)
        self.answered.append(answer.seq)
        self.by_status[answer.status] = self.by_status.get(answer.status, 0) + 1
        if answer.status in PROCESSED:
            self.latencies_ms.append(1000 * answer.latency)

    def test_soak(self):
        self.answered, self.by_status, self.latencies_ms, self.status = [], {}, [], None
        camera = Camera(self.record_messages(8, OPTIONS.kind, OPTIONS.width))
        listener = self.listen(self.note, {HANDLES, STATUS})
        daemon = self.start_listening("graspd", "--config", self.write_config(CONFIG))
        wait_until(lambda: (listener.receive(0.02), self.status)[1], "the first status")
        process, samples = Process(daemon.process.pid), []
        start, warm = time.monotonic(), None
        while warm is None or time.monotonic() - warm < OPTIONS.seconds or len(self.latencies_ms) < 2 * FEWEST:
            if warm is None and time.monotonic() - start > OPTIONS.warm_up and len(self.latencies_ms) >= FEWEST:
                warm = time.monotonic()
            if warm is not None and len(samples) < time.monotonic() - warm:
                samples.append((process.rss_bytes(), process.descriptors(), process.threads()))
            self.send_paced(listener, CLOUDS, camera.next())
            self.receive_until(listener, start + camera.seq / OPTIONS.rate)
        wait_until(lambda: (listener.receive(0.02), len(self.answered) >= camera.seq)[1], "the last answers")
        elapsed = time.monotonic() - start
        self.report(camera.seq, elapsed, samples)
        self.judge(camera.seq, samples)
        self.assertEqual(daemon.stop()[0], 0, daemon.err)

    @staticmethod
    def quarters(samples, column):
        """Medians over the first and the last quarter."""
        values, n = [s[column] for s in samples], max(1, len(samples) // 4)
        return statistics.median(values[:n]), statistics.median(values[-n:])

    def report(self, sent, elapsed, samples):
        rss, fds, threads = (self.quarters(samples, c) for c in range(3))
        dropped = self.by_status.get(LIST["OVERLOADED"], 0)
        table(("trial", "soak"), ("length", f"{elapsed:.0f} s at {sent / elapsed:.1f} Hz"),
              ("frames", f"{OPTIONS.width} pixels wide, {OPTIONS.kind}"), ("sent", sent), ("answered", len(self.answered)),
              ("dropped for newer", dropped), ("p50 / p99 [ms]", f"{percentile(self.latencies_ms, 0.5):.0f} / "
                                               f"{percentile(self.latencies_ms, 0.99):.0f}"),
              ("RSS [MB]", f"{rss[0] / 1e6:.1f} -> {rss[1] / 1e6:.1f} ({100 * (rss[1] / rss[0] - 1):+.1f} %)"),
              ("descriptors", f"{fds[0]:.0f} -> {fds[1]:.0f}"), ("threads", f"{threads[0]:.0f} -> {threads[1]:.0f}"))

    def judge(self, sent, samples):
        self.assertEqual(self.answered, list(range(sent)), "each frame once, in order")
        self.assertTrue(set(self.by_status) <= PROCESSED | {LIST["OVERLOADED"]}, self.by_status)
        self.assertGreater(len(self.latencies_ms), 0)
        rss, fds, threads = (self.quarters(samples, c) for c in range(3))
        if OPTIONS.seconds >= LONG_S:
            self.assertLess(rss[1], 1.02 * rss[0], "memory grows")
        self.assertLessEqual(rss[1], 1.5 * rss[0], "memory grows")
        self.assertLessEqual(fds[1], fds[0])
        self.assertLessEqual(threads[1], threads[0])


if __name__ == "__main__":
    run_trial()
