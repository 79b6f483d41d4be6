# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Four cameras at once, more than can be worked on: each frame is answered or honestly dropped, none is starved."""
import time

from trial import (LIST, NAME_OF_STATUS, PROCESSED, STATUS, TYPES, Camera, Trial, options_of, percentile, run_trial, table,
                   wait_until)

OPTIONS = options_of(__doc__, seconds=5.0, rate=30.0, sources=4, width=320, kind="depth")
SOURCE = "  - {{name: s{0}, channel: CLOUD_{0}, handles_channel: HANDLES_{0}, policy: latest}}\n"


class Load(Trial):
    def note(self, channel, data):
        if channel == STATUS:
            self.status = TYPES["status_t"].decode(data)
            return
        answer = TYPES["handle_list_t"].decode(data)
        self.answers[int(channel.split("_")[1])].append((answer.seq, answer.status, answer.latency))

    def test_load(self):
        n = OPTIONS.sources
        self.answers, self.status = [[] for _ in range(n)], None
        cameras = [Camera(self.record_messages(4, OPTIONS.kind, OPTIONS.width))]
        cameras += [Camera(cameras[0]._messages) for _ in range(n - 1)]
        listener = self.listen(self.note, {STATUS} | {f"HANDLES_{i}" for i in range(n)})
        config = "sources:\n" + "".join(SOURCE.format(i) for i in range(n))
        daemon = self.start_listening("graspd", "--config", self.write_config(config))
        wait_until(lambda: (listener.receive(0.02), self.status)[1], "the first status")
        start = time.monotonic()
        while time.monotonic() - start < OPTIONS.seconds:
            for i, camera in enumerate(cameras):
                self.send_paced(listener, f"CLOUD_{i}", camera.next())
            self.receive_until(listener, start + cameras[0].seq / OPTIONS.rate)
        elapsed = time.monotonic() - start
        wait_until(lambda: (listener.receive(0.02), all(len(a) >= c.seq for a, c in zip(self.answers, cameras)))[1],
                   "all answers")
        sent = sum(c.seq for c in cameras)
        wait_until(lambda: (listener.receive(0.02), sum(s.received for s in self.status.sources) == sent and
                            all(s.pending == 0 for s in self.status.sources))[1], "the last status")
        self.report(sent, elapsed)
        self.judge(cameras)
        self.assertEqual(daemon.stop()[0], 0, daemon.err)

    def processed(self):
        return [sum(status in PROCESSED for _, status, _ in a) for a in self.answers]

    def report(self, sent, elapsed):
        answered = sum(len(a) for a in self.answers)
        dropped = sum(status == LIST["OVERLOADED"] for a in self.answers for _, status, _ in a)
        latencies_ms = [1000 * t for a in self.answers for _, status, t in a if status in PROCESSED]
        table(("trial", "load"), ("length", f"{elapsed:.0f} s, {OPTIONS.sources} sources at "
                                            f"{sent / elapsed / OPTIONS.sources:.1f} Hz"),
              ("frames", f"{OPTIONS.width} pixels wide, {OPTIONS.kind}"), ("sent", sent),
              ("answered", f"{answered} ({100 * answered / sent:.2f} %)"), ("dropped for newer", dropped),
              ("worked on, by source", " ".join(map(str, self.processed()))),
              ("p50 / p99 [ms]", f"{percentile(latencies_ms, 0.5):.0f} / {percentile(latencies_ms, 0.99):.0f}"))

    def judge(self, cameras):
        for i, (answers, camera) in enumerate(zip(self.answers, cameras)):
            self.assertEqual([seq for seq, _, _ in answers], list(range(camera.seq)), f"source {i}: each once, in order")
            kinds = {NAME_OF_STATUS[s] for _, s, _ in answers}
            self.assertTrue(kinds <= {"OK", "NO_HANDLES", "OVERLOADED"}, kinds)
            source = next(s for s in self.status.sources if s.name == f"s{i}")
            self.assertEqual(source.dropped, sum(s == LIST["OVERLOADED"] for _, s, _ in answers), "honest drops")
            self.assertEqual((source.lost, source.refused), (0, 0))
        counts = self.processed()
        self.assertGreater(min(counts), 0)
        self.assertGreaterEqual(2 * min(counts) + 2, max(counts), f"a source is starved: {counts}")


if __name__ == "__main__":
    run_trial()
