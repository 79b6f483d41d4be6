# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Frames as messages in our hands: recorded once from graspd-publish, then sent again as a test wants them."""
from harness import CLOUDS, TYPES, GraspdTest, wait_until
from lcm_udp import PORT, Bus


def waiting_bytes():
    """The fullest receive buffer of any socket on LCM's port [bytes]."""
    with open("/proc/net/udp", encoding="ascii") as table:
        rows = [line.split() for line in list(table)[1:]]
    return max((int(row[4].split(":")[1], 16) for row in rows if row[1].endswith(f":{PORT:04X}")), default=0)


# A subscription keeps 30 messages for a daemon that has no time just then; LCM drops what comes on top.
MOST_AT_ONCE = 25


class TrafficTest(GraspdTest):
    def record_frames(self, count, kind="cloud", **size):
        """Simulated frames as decoded messages."""
        frames = self.simulate(count, **size)
        with Bus() as bus:
            self.run_program("graspd-publish", "--type", kind, "--rate", 20, frames)
            wait_until(lambda: (bus.receive(0.02), len(bus.on(CLOUDS)) == count)[1], "the published frames")
        wire_type = TYPES["point_cloud_t" if kind == "cloud" else "depth_image_t"]
        return bus.on(CLOUDS, wire_type)

    @staticmethod
    def encoded(frame):
        wire_type = TYPES["point_cloud_t" if hasattr(frame, "fields") else "depth_image_t"]
        return wire_type.encode(**vars(frame))

    def with_seq(self, frame, seq):
        frame.seq, frame.utime = seq, 1_000_000 + seq
        return self.encoded(frame)

    @staticmethod
    def publish_paced(bus, channel, data):
        """Sends when every socket has taken what came before, so that the kernel has no reason to drop anything. After
        MOST_AT_ONCE it must be seen that the daemon has them."""
        wait_until(lambda: (bus.receive(0), waiting_bytes() == 0)[1], "the receivers to take the last message")
        bus.publish(channel, data)
