# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Packets that nobody should send: refused, counted, answered, and good frames are served as before."""
import random
import struct

from harness import CLOUDS, HANDLES, TYPES, run_tests
from lcm_udp import LONG, SHORT
from traffic import MOST_AT_ONCE, TrafficTest

LIST = TYPES["handle_list_t"].constants
CONFIG = """
sources:
  - name: camera
    channel: GRASPD_CLOUD
    policy: all
    queue_length: 200
"""
GOOD = {LIST["OK"], LIST["NO_HANDLES"]}


def replaced(data, at, code, value):
    """The message with one number written over."""
    out = bytearray(data)
    struct.pack_into(code, out, at, value)
    return bytes(out)


class Hostile(TrafficTest):
    def setUp(self):
        super().setUp()
        self.cloud = self.record_frames(1, width=160)[0]
        self.cloud.frame_name = "f"
        self.cloud.seq = 1
        self.bus = self.open_bus()
        self.daemon = self.start_daemon(self.bus, self.write_config(CONFIG))

    def assert_refused(self, messages):
        """Every message is answered REFUSED and counted with a reason; a good frame before and after is served."""
        good = self.encoded(self.cloud)
        self.assertLessEqual(len(messages) + 2, MOST_AT_ONCE + 1)
        for message in [good] + messages + [good]:
            self.publish_paced(self.bus, CLOUDS, message)
        answers = self.await_answers(self.bus, len(messages) + 2)
        self.assertIn(answers[0].status, GOOD)
        self.assertIn(answers[-1].status, GOOD)
        for number, answer in enumerate(answers[1:-1]):
            self.assertEqual(answer.status, LIST["REFUSED"], f"message {number}: {answer.status_text}")
            self.assertGreater(len(answer.status_text), 10)
        status = self.await_status(self.bus, lambda s: s.sources and s.sources[0].received == len(answers) and
                                   s.sources[0].pending == 0, "all of them in the status")
        source = status.sources[0]
        self.assertEqual((source.refused, source.processed), (len(messages), 2))
        self.assertEqual(sum(r.count for r in source.refusals), len(messages))
        self.assertTrue(source.last_error)
        self.assertEqual(self.daemon.process.poll(), None, self.daemon.err)
        return answers[1:-1]

    def test_bytes_that_are_no_message(self):
        noise = random.Random(1)
        fingerprints = [TYPES[t].fingerprint for t in ("point_cloud_t", "depth_image_t")]
        self.assert_refused([b"", b"\0", b"short", bytes(8), bytes(5000), noise.randbytes(3000)] +
                            [f + noise.randbytes(n) for f in fingerprints for n in (0, 1, 7, 8, 60, 400)])

    def test_another_type(self):
        answers = self.assert_refused([TYPES["stage_time_t"].encode(stage="x", milliseconds=1.0)])
        self.assertRegex(answers[0].status_text, r"(?i)type|fingerprint")

    def test_truncated_at_many_places(self):
        whole = self.encoded(self.cloud)
        ends = list(range(8, 200, 9)) + [len(whole) // 2, len(whole) - 1]
        self.assert_refused([whole[:end] for end in ends])

    def test_bytes_after_the_end(self):
        self.assert_refused([self.encoded(self.cloud) + b"\0"])

    def test_lying_numbers(self):
        good = self.encoded(self.cloud)
        name_length = 24  # fingerprint, utime, seq
        width = name_length + 4 + len("f") + 1 + 24
        lies = []
        for value in (-(1 << 31), -1, (1 << 31) - 1):
            lies += [replaced(good, at, ">i", value) for at in (name_length, width, width + 4, width + 8)]
        step = len(good) - self.cloud.data_size - 8
        for value in (-(1 << 31), -1, 0, 1, 11, self.cloud.point_step + 1, (1 << 31) - 1):
            lies.append(replaced(good, step, ">i", value))
        for value in (-(1 << 31), -1, self.cloud.data_size - 1, self.cloud.data_size + 1, (1 << 31) - 1):
            lies.append(replaced(good, step + 4, ">i", value))
        self.assert_refused(lies)

    def test_fields_that_lie(self):
        lies = []
        for change in (dict(offset=-4), dict(offset=1 << 30), dict(offset=self.cloud.point_step - 3),
                       dict(datatype=99), dict(datatype=1), dict(count=0), dict(count=1 << 30), dict(name="q")):
            x = self.cloud.fields[0]
            before = dict(vars(x))
            vars(x).update(change)
            lies.append(self.encoded(self.cloud))
            vars(x).update(before)
        self.assert_refused(lies)

    def test_what_is_no_lcm_packet_does_no_harm(self):
        noise = random.Random(2)
        name = CLOUDS.encode() + b"\0"
        for size in (0, 1, 4, 7, 8, 9, 20, 500):
            self.bus.send_datagram(noise.randbytes(size))
            self.bus.send_datagram(struct.pack(">II", SHORT, 1) + noise.randbytes(size).replace(b"\0", b"a"))
        # Without a first fragment that is shorter than its channel's name: liblcm 1.3.1 itself does not survive that.
        for size, offset, number, count in ((1 << 31, 0, 0, 2), (100, 90, 0, 1), (100, 1 << 31, 1, 2), (100, 0, 5, 2),
                                            (1000, 0, 0, 65535)):
            header = struct.pack(">IIIIHH", LONG, 7000 + count, size, offset, number, count)
            self.bus.send_datagram(header + name + bytes(50))
        self.publish_paced(self.bus, CLOUDS, self.encoded(self.cloud))
        self.await_good_answer(self.cloud.seq)

    def await_good_answer(self, seq):
        def served(status):
            return status.sources and status.sources[0].processed > 0
        self.await_status(self.bus, served, "the good frame")
        answers = [a for a in self.bus.on(HANDLES, TYPES["handle_list_t"]) if a.seq == seq]
        self.assertEqual(len(answers), 1)
        self.assertIn(answers[0].status, GOOD)
        self.assertIsNone(self.daemon.process.poll(), self.daemon.err)

    def test_empty_and_senseless_clouds_are_answered_by_name(self):
        points, step = self.cloud.width * self.cloud.height, self.cloud.point_step
        nothing_finite = struct.pack("<f", float("nan")) * (points * step // 4)
        for changes, status in ((dict(width=0, height=1, data_size=0, data=b""), "EMPTY_CLOUD"),
                                (dict(data=nothing_finite), "NO_FINITE_POINTS"),
                                (dict(data=struct.pack("<f", 1e6) * (points * step // 4)), "NOTHING_IN_WORKSPACE")):
            message = TYPES["point_cloud_t"].encode(**{**vars(self.cloud), **changes})
            self.publish_paced(self.bus, CLOUDS, message)
            count = len(self.bus.on(HANDLES)) + 1
            answer = self.await_answers(self.bus, count)[-1]
            self.assertEqual(answer.status, LIST[status], answer.status_text)
            self.assertEqual((answer.seq, answer.num_handles), (self.cloud.seq, 0))


if __name__ == "__main__":
    run_tests()
