# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Who asks sees the points and segments of each frame, for as long as it asks; the handles are the same."""
import struct

from harness import CLOUDS, HANDLES, TYPES, run_tests, wait_until
from sealing import Sealer, now_us
from traffic import TrafficTest

SEGMENTS, REQUESTS = "GRASPD_SEGMENTS", "GRASPD_REQUESTS"
WIRE = TYPES["segmentation_t"]
NO_SEGMENT, POINT_BYTES = WIRE.constants["NO_SEGMENT"], WIRE.constants["POINT_BYTES"]
ALWAYS = "sources: [{name: camera, channel: GRASPD_CLOUD, publish_segments: always, sensor_pose: {frame_name: base, " \
         "position_m: [1, 2, 3]}}]"
MOST_BYTES = 500_000  # of a VGA frame's message


def request(seconds, channel=""):
    return TYPES["segmentation_request_t"].encode(utime=now_us(), source_channel=channel, seconds=seconds)


def points(message):
    """x, y, z, segment and flags of every point, and its position."""
    for record in struct.iter_unpack("<5H", message.data):
        yield record, [o + message.step * q for o, q in zip(message.origin, record)]


class Segments(TrafficTest):
    def answer(self, frame, seq):
        """The handle list of a frame, and the segmentation that came with it or None: it comes before the next list."""
        before = len(self.bus.on(HANDLES))
        self.publish_paced(self.bus, CLOUDS, frame)
        self.await_answers(self.bus, before + 1)
        self.publish_paced(self.bus, CLOUDS, b"no cloud")
        answer = self.await_answers(self.bus, before + 2)[before]
        found = [m for m in self.bus.on(SEGMENTS, WIRE) if m.seq == seq]
        self.assertLessEqual(len(found), 1)
        return answer, found[0] if found else None

    def until(self, wanted, frame, first_seq, asked=None):
        """Sends the frame until its answer comes with or without segments, as wanted; before each, what is asked."""
        seq = first_seq

        def arrived():
            nonlocal seq
            seq += 1
            if asked:
                self.bus.publish(REQUESTS, asked())
            pair = self.answer(self.with_seq(frame, seq), seq)
            return pair if (pair[1] is not None) == wanted else None
        return wait_until(arrived, "segments to come" if wanted else "segments to end")

    def assert_belongs_to(self, message, answer):
        self.assertEqual((message.utime, message.seq, message.source_channel, message.frame_name),
                         (answer.utime, answer.seq, answer.source_channel, answer.frame_name))
        self.assertLess(message.num_points, answer.points_used)  # of the support there are fewer
        self.assertEqual(message.num_segments, answer.num_segments)
        self.assertEqual(len(message.data), POINT_BYTES * message.num_points)
        counted = [0] * message.num_segments
        for record, _ in points(message):
            if record[3] != NO_SEGMENT:
                counted[record[3]] += 1
        self.assertEqual(counted, [segment.num_points for segment in message.segments])
        without = {}
        for segment in message.segments:
            if segment.num_handles == 0:
                without[segment.reason] = without.get(segment.reason, 0) + 1
        self.assertEqual(without, {entry.reason: entry.count for entry in answer.segment_failures})
        for handle in answer.handles:
            self.assertGreater(message.segments[handle.segment_id].num_handles, 0)

    def test_a_request_brings_them_for_its_time(self):
        frame = self.record_frames(1)[0]
        self.bus = self.open_bus()
        self.start_daemon(self.bus)
        plain, none = self.answer(self.with_seq(frame, 1), 1)
        self.assertIsNone(none)
        self.bus.publish(REQUESTS, request(60, "OTHER"))
        self.assertIsNone(self.answer(self.with_seq(frame, 2), 2)[1])
        answer, message = self.until(True, frame, 100, lambda: request(2, CLOUDS))
        self.assert_belongs_to(message, answer)
        self.assertEqual([vars(h) for h in answer.handles], [vars(h) for h in plain.handles])
        self.until(False, frame, 100_000)

    def test_always_in_the_frame_of_the_handles(self):
        frame = self.record_frames(1, width=640)[0]
        self.bus = self.open_bus()
        self.start_daemon(self.bus, self.write_config(ALWAYS))
        answer, message = self.answer(self.with_seq(frame, 1), 1)
        self.assert_belongs_to(message, answer)
        self.assertEqual(message.frame_name, "base")
        self.assertLess(len(WIRE.encode(**vars(message))), MOST_BYTES)
        handle = answer.handles[0]
        nearest = min(sum((a - b) ** 2 for a, b in zip(handle.position, position))
                      for record, position in points(message) if record[3] == handle.segment_id) ** 0.5
        self.assertLess(nearest, 0.05)  # lifted at most by as much as keeps the fingertips off the support

    def test_with_keys_requests_are_signed_too(self):
        key_file = self.folder / "key"
        self.run_program("graspd-keygen", key_file)
        sealer = Sealer.from_file(key_file)
        frame = self.record_frames(1, width=160)[0]
        self.bus = self.open_bus()
        daemon = self.start_daemon(self.bus, self.write_config(f'authentication: {{key_file: "{key_file}", max_age_s: 60}}'))
        original = self.with_seq
        self.with_seq = lambda f, seq: sealer.seal(CLOUDS, original(f, seq))
        for bad in (request(60), sealer.seal(CLOUDS, request(60)), sealer.seal(REQUESTS, b"nonsense"), b""):
            self.bus.publish(REQUESTS, bad)
        wait_until(lambda: daemon.err.count("request_refused") >= 4, "four refusals in the log")
        self.assertIsNone(self.answer(self.with_seq(frame, 1), 1)[1])
        self.bus.publish(REQUESTS, sealer.seal(REQUESTS, request(60)))
        answer, message = self.until(True, frame, 100)
        self.assert_belongs_to(message, answer)


if __name__ == "__main__":
    run_tests()
