# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""More frames than can be worked on: each is answered, the newest is worked on, dropped ones say so."""
from harness import CLOUDS, HANDLES, TYPES, run_tests
from traffic import MOST_AT_ONCE, TrafficTest

CONFIG = """
workers: 1
sources:
  - name: camera
    channel: GRASPD_CLOUD
    policy: {policy}
    queue_length: {queue}
"""
COUNT = MOST_AT_ONCE


class Overload(TrafficTest):
    def flood(self, policy, queue):
        frame = self.record_frames(1)[0]
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(CONFIG.format(policy=policy, queue=queue)))
        for seq in range(COUNT):
            self.publish_paced(bus, CLOUDS, self.with_seq(frame, seq))
        answers = self.await_answers(bus, COUNT)
        status = self.await_status(bus, lambda s: s.sources and s.sources[0].received == COUNT and
                                   s.sources[0].pending == 0, "a status that counts every frame")
        overloaded = TYPES["handle_list_t"].constants["OVERLOADED"]
        dropped = [a.seq for a in answers if a.status == overloaded]

        self.assertEqual([a.seq for a in answers], list(range(COUNT)))
        self.assertEqual(len(bus.on(HANDLES)), COUNT)
        self.assertEqual(status.sources[0].dropped, len(dropped))
        self.assertEqual(status.sources[0].processed, COUNT - len(dropped))
        self.assertEqual((status.sources[0].refused, status.sources[0].lost), (0, 0))
        for answer in answers:
            self.assertEqual(answer.source_channel, CLOUDS)
            if answer.status == overloaded:
                self.assertEqual(answer.num_handles, 0)
                self.assertTrue(answer.status_text)
        return dropped

    def test_latest(self):
        dropped = self.flood("latest", 1)
        self.assertGreater(len(dropped), 0)
        self.assertNotIn(COUNT - 1, dropped)

    def test_all_with_a_long_queue_drops_nothing(self):
        self.assertEqual(self.flood("all", COUNT), [])

    def test_all_with_a_short_queue_drops_the_oldest(self):
        dropped = self.flood("all", 3)
        self.assertGreater(len(dropped), 0)
        for newest in (COUNT - 1, COUNT - 2, COUNT - 3):
            self.assertNotIn(newest, dropped)


if __name__ == "__main__":
    run_tests()
