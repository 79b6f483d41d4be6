# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Several sources at once: each keeps its order, its pose and its channel."""
from harness import TYPES, run_tests
from traffic import MOST_AT_ONCE, TrafficTest

TWO = """
workers: 2
sources:
  - name: left
    channel: LEFT_CLOUD
    handles_channel: LEFT_HANDLES
    policy: all
    queue_length: 100
  - name: right
    channel: RIGHT_CLOUD
    handles_channel: RIGHT_HANDLES
    policy: all
    queue_length: 100
    sensor_pose: {frame_name: base, position_m: [1, 2, 3]}
"""
PATTERN = """
sources:
  - name: cameras
    channel: CAMERA_[0-9]+
    handles_channel: ALL_HANDLES
    policy: all
    queue_length: 100
"""
COUNT = MOST_AT_ONCE


class Sources(TrafficTest):
    def test_two_sources_keep_their_order(self):
        small, large = (self.record_frames(1, width=width)[0] for width in (160, 320))
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(TWO))
        for seq in range(COUNT):
            # Large and small ones in turn, so that later frames are done earlier.
            self.publish_paced(bus, "LEFT_CLOUD", self.with_seq(large if seq % 2 else small, seq))
            self.publish_paced(bus, "RIGHT_CLOUD", self.with_seq(small if seq % 2 else large, seq))
        left = self.await_answers(bus, COUNT, "LEFT_HANDLES")
        right = self.await_answers(bus, COUNT, "RIGHT_HANDLES")
        for answers, channel in ((left, "LEFT_CLOUD"), (right, "RIGHT_CLOUD")):
            self.assertEqual([a.seq for a in answers], list(range(COUNT)))
            self.assertEqual({a.source_channel for a in answers}, {channel})
        self.assert_same_handles_in_another_frame(left[0], right[1])

    def assert_same_handles_in_another_frame(self, plain, moved):
        """Both answer the small frame; the second source's pose is a pure translation by 1, 2, 3 m."""
        self.assertEqual(moved.frame_name, "base")
        self.assertNotEqual(plain.frame_name, "base")
        self.assertEqual(len(moved.handles), len(plain.handles))
        for a, b in zip(plain.handles, moved.handles):
            for axis in range(3):
                self.assertAlmostEqual(a.position[axis] + (1, 2, 3)[axis], b.position[axis], places=5)
            self.assertEqual(a.width, b.width)

    def test_channels_of_a_regular_expression_are_sources_of_their_own(self):
        frame = self.record_frames(1, width=160)[0]
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(PATTERN))
        channels = ["CAMERA_1", "CAMERA_22", "CAMERA_333"]
        count = COUNT // len(channels)
        for seq in range(count):
            for channel in channels + ["CAMERA_X", "NO_CAMERA_1"]:
                self.publish_paced(bus, channel, self.with_seq(frame, seq))
        answers = self.await_answers(bus, count * len(channels), "ALL_HANDLES")
        self.assertEqual({a.source_channel for a in answers}, set(channels))
        for channel in channels:
            self.assertEqual([a.seq for a in answers if a.source_channel == channel], list(range(count)))
        status = self.await_status(bus, lambda s: sum(x.processed for x in s.sources) == count * len(channels),
                                   "a status with all frames")
        counted = {x.channel: x.processed for x in status.sources if x.received}
        self.assertEqual(counted, dict.fromkeys(channels, count))

    def test_a_gap_in_the_numbers_is_counted_as_lost(self):
        frame = self.record_frames(1, width=160)[0]
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(TWO))
        for seq in (5, 6, 9, 10, 20):
            self.publish_paced(bus, "LEFT_CLOUD", self.with_seq(frame, seq))
        self.await_answers(bus, 5, "LEFT_HANDLES")
        status = self.await_status(bus, lambda s: any(x.channel == "LEFT_CLOUD" and x.processed == 5
                                                      for x in s.sources), "a status with all frames")
        self.assertEqual([x.lost for x in status.sources if x.channel == "LEFT_CLOUD"], [2 + 9])
        self.assertEqual(len(bus.on("RIGHT_HANDLES", TYPES["handle_list_t"])), 0)


if __name__ == "__main__":
    run_tests()
