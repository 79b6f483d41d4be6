# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""SIGTERM and SIGINT in the middle of the work: every program ends with 0, the daemon within 2 s and with a last status."""
import signal

from harness import CLOUDS, HANDLES, STATUS, STOP_WITHIN_S, TYPES, run_tests, wait_until
from traffic import TrafficTest

STOPPING = TYPES["status_t"].constants["STOPPING"]
CONFIG = """
workers: 2
on_stop: {on_stop}
sources:
  - name: camera
    channel: GRASPD_CLOUD
    policy: all
    queue_length: 30
"""


class Signals(TrafficTest):
    def stop_daemon_at_work(self, number, on_stop):
        frames = self.record_frames(2)
        bus = self.open_bus()
        daemon = self.start_daemon(bus, self.write_config(CONFIG.format(on_stop=on_stop)))
        for seq in range(20):
            self.publish_paced(bus, CLOUDS, self.with_seq(frames[seq % 2], seq))
        self.await_answers(bus, 1)
        code, seconds = daemon.stop(number)
        self.assertEqual(code, 0, daemon.err)
        self.assertLess(seconds, STOP_WITHIN_S)
        bus.receive(0.1)
        last = bus.on(STATUS, TYPES["status_t"])[-1]
        self.assertEqual(last.state, STOPPING)
        source = last.sources[0]
        self.assertEqual(source.pending, 0)
        self.assertEqual(source.received, source.processed + source.dropped + source.refused)
        answers = bus.on(HANDLES, TYPES["handle_list_t"])
        self.assertEqual([a.seq for a in answers], list(range(source.received)))

    def test_sigterm_and_finish(self):
        self.stop_daemon_at_work(signal.SIGTERM, "finish")

    def test_sigint_and_finish(self):
        self.stop_daemon_at_work(signal.SIGINT, "finish")

    def test_sigterm_and_drop(self):
        self.stop_daemon_at_work(signal.SIGTERM, "drop")

    def test_sigint_and_drop(self):
        self.stop_daemon_at_work(signal.SIGINT, "drop")

    def assert_stops(self, program, number):
        code, _ = program.stop(number)
        self.assertEqual(code, 0, program.err)

    def test_listening_programs(self):
        for number in (signal.SIGTERM, signal.SIGINT):
            with self.subTest(signal=number):
                for name, *options in (["graspd-listen"], ["graspd-log", self.folder / f"log{number}"],
                                       ["graspd-status"]):
                    self.assert_stops(self.start_listening(name, *options), number)

    def test_publishing_programs(self):
        frames = self.simulate(2)
        bus = self.open_bus()
        for number in (signal.SIGTERM, signal.SIGINT):
            for name, *options in (["graspd-publish", "--loop", "--rate", 20, frames],
                                   ["graspd-simulate", "--rate", 20, "--width", 160]):
                with self.subTest(signal=number, program=name):
                    before = len(bus.on(CLOUDS))
                    program = self.start(name, *options)
                    wait_until(lambda: (bus.receive(0.02), len(bus.on(CLOUDS)) > before + 3)[1], "frames on the bus")
                    self.assert_stops(program, number)


if __name__ == "__main__":
    run_tests()
