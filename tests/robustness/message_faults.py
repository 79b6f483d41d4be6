# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Faults of what comes in: messages that no driver should send."""
import random
import struct

from trial import CLOUD, IMAGE, MEGABYTE, SANITIZED, TYPES, Process


def fault(name, expected):
    """Marks a method as a fault; its docstring says how it is injected."""
    def mark(method):
        method.fault = (name, expected)
        return method
    return mark


class MessageFaults:
    """For a test that has answers_to() and a cloud."""

    @fault("not a number", "NO_FINITE_POINTS")
    def fault_nan(self):
        """a cloud of NaN and infinities"""
        return self.names(self.points([(float("nan"), float("inf"), float("-inf"))] * 500))

    @fault("denormals", "NO_HANDLES or NOTHING_IN_WORKSPACE")
    def fault_denormals(self):
        """coordinates of 1e-45 m"""
        return self.names(self.points([(1e-45, -1e-45, 1e-45)] * 500))

    @fault("huge coordinates", "NOTHING_IN_WORKSPACE")
    def fault_huge(self):
        """coordinates of 1e30 m"""
        return self.names(self.points([(1e30, -1e30, 1e30)] * 500))

    @fault("all points equal", "NO_HANDLES")
    def fault_equal(self):
        """5,000 times the same point"""
        return self.names(self.points([(0.1, 0.2, 0.7)] * 5000))

    @fault("points on a line", "NO_HANDLES")
    def fault_line(self):
        """5,000 points on one line"""
        return self.names(self.points([(0.0001 * i, 0.0001 * i, 0.7) for i in range(5000)]))

    @fault("a million points in one cell", "NO_HANDLES")
    def fault_million(self):
        """10^6 points within one voxel"""
        data = struct.pack("<fff", 0.1, 0.2, 0.7) * 1_000_000
        return self.names(self.changed_cloud(width=1_000_000, height=1, fields=self.cloud.fields[:3], num_fields=3,
                                             point_step=12, data_size=len(data), data=data))

    @fault("no points", "EMPTY_CLOUD")
    def fault_empty(self):
        """a cloud of 0 points, an image of 0 x 480 pixels"""
        none = IMAGE.encode(**{**vars(self.image), "width": 0, "data_size": 0, "data": b""})
        return self.names(self.changed_cloud(width=0, height=1, data_size=0, data=b""), none)

    @fault("counts of 2^31", "REFUSED")
    def fault_counts(self):
        """2^31 - 1 and -2^31 for width, height, number of fields, length of the name"""
        good, places = self.good(), (24, 24 + 4 + len(self.cloud.frame_name) + 1 + 24)
        lies = []
        for value in (0x7FFFFFFF, -0x80000000):
            for at in (places[0], places[1], places[1] + 4, places[1] + 8):
                lies.append(good[:at] + struct.pack(">i", value) + good[at + 4:])
        return self.names(*lies)

    @fault("lying data size", "REFUSED")
    def fault_size(self):
        """data_size of 2^31 - 1, -1, one too many"""
        size = self.cloud.data_size
        at = len(self.good()) - size - 4
        return self.names(*[self.good()[:at] + struct.pack(">i", v) + self.good()[at + 4:] for v in (0x7FFFFFFF, -1, size + 1)])

    @fault("wrong endianness", "an answer, whatever it says")
    def fault_endianness(self):
        """coordinates with their bytes the other way round; then all of the header so"""
        data = b"".join(self.cloud.data[i:i + 4][::-1] for i in range(0, len(self.cloud.data), 4))
        little = self.good()[:8] + struct.pack("<qq", 1, 2) + struct.pack("<i", 1) + self.good()[28:]
        return self.names(self.changed_cloud(data=data), little)

    @fault("truncated messages", "REFUSED")
    def fault_truncated(self):
        """a cloud cut at 40 places"""
        whole = self.good()
        return self.names(*[whole[:len(whole) * i // 40] for i in range(40)])

    @fault("unknown types", "REFUSED")
    def fault_unknown(self):
        """our own answers and status, random fingerprints"""
        noise = random.Random(1)
        return self.names(TYPES["stage_time_t"].encode(stage="x", milliseconds=1.0), *[noise.randbytes(100) for _ in range(10)])

    @fault("a message over the limit", "REFUSED")
    def fault_too_large(self):
        """30 MB where 20 MB are allowed"""
        return self.names(CLOUD.fingerprint + bytes(30 * MEGABYTE))

    @fault("too many points", "REFUSED")
    def fault_too_many(self):
        """1.2 million points where 1.1 million are allowed"""
        data = bytes(12 * 1_200_000)
        return self.names(self.changed_cloud(width=1_200_000, height=1, fields=self.cloud.fields[:3], num_fields=3,
                                             point_step=12, data_size=len(data), data=data))

    @fault("noise on the port", "nothing at all")
    def fault_noise(self):
        """2,000 datagrams of random bytes"""
        noise = random.Random(2)
        for i in range(2000):
            self.listener.send_datagram(noise.randbytes(noise.randrange(1, 1400)))
            if i % 50 == 0:
                self.listener.receive(0.001)
        return "nothing at all"

    @fault("fragments that never end", "memory stays within 400 MB")
    def fault_fragments(self):
        """3,000 first fragments of messages of 60 kB to 300 MB"""
        process = Process(self.daemon.process.pid)
        before = process.rss_bytes()
        for i in range(300 if SANITIZED else 3000):  # a sanitizer marks all of such memory, for minutes
            header = struct.pack(">IIIIHH", 0x4C433033, 1_000_000 + i, (i + 1) * 100_000, 0, 0, min(65535, i + 2))
            self.listener.send_datagram(header + b"GRASPD_CLOUD\0" + bytes(1000))
            if i % 50 == 0:
                self.listener.receive(0.001)
        grown = (process.rss_bytes() - before) / MEGABYTE
        self.assertLess(grown, 400)
        return "memory stays within 400 MB"
