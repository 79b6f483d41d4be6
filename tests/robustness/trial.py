# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the robustness programs share: a camera that repeats recorded frames, a light listener, a look at a process."""
import argparse
import math
import os
import pathlib
import struct
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "integration"))
from harness import BIN, CLOUDS, HANDLES, SANITIZED, STATUS, TYPES, listening_sockets, run_tests, wait_until  # noqa: E402, F401
from lcm_udp import Bus  # noqa: E402
from traffic import MOST_AT_ONCE, TrafficTest, waiting_bytes  # noqa: E402, F401

LIST = TYPES["handle_list_t"].constants
CLOUD, IMAGE = TYPES["point_cloud_t"], TYPES["depth_image_t"]
MEGABYTE = 1 << 20
NAME_OF_STATUS = {value: key for key, value in LIST.items()}
PROCESSED = {LIST["OK"], LIST["NO_HANDLES"]}


def options_of(doc, **defaults):
    """Command-line options by their defaults."""
    parser = argparse.ArgumentParser(description=doc)
    for name, value in defaults.items():
        parser.add_argument("--" + name.replace("_", "-"), type=type(value), default=value, help="default: %(default)s")
    return parser.parse_args()


def run_trial():
    """Runs the calling file's trial in a private network; its own options are for it alone."""
    run_tests([sys.argv[0]])


def table(*columns):
    """Prints one Markdown table: (title, value) each."""
    titles, values = zip(*columns)
    print(f"\n| {' | '.join(titles)} |\n|{'---|' * len(titles)}\n| {' | '.join(map(str, values))} |", flush=True)


def percentile(values, share):
    ordered = sorted(values)
    return ordered[max(0, math.ceil(share * len(ordered)) - 1)] if ordered else math.nan


class Listener(Bus):
    """Hands over the messages of some channels one by one, and keeps none."""

    def __init__(self, use, channels, address="127.0.0.1"):
        super().__init__(address)
        self._use, self._channels, self._skipped, self._unlooked_bytes = use, channels, {}, 0

    def receive(self, seconds):
        super().receive(seconds)
        for channel, data in self.messages:
            if channel in self._channels:
                self._use(channel, data)
        self.messages.clear()

    def send_datagram(self, data):
        """A large message waits for its receivers in between, too."""
        self._unlooked_bytes += len(data)
        if self._unlooked_bytes > 1 << 19:
            wait_until(lambda: (self.receive(0), waiting_bytes() < 1 << 20)[1], "the receivers")
            self._unlooked_bytes = 0
        super().send_datagram(data)

    def _take_fragment(self, data, key):
        """Without putting together what nobody wants."""
        number, = struct.unpack_from(">H", data, 16)
        if number == 0:
            self._skipped[key[0]] = None
            if data[20:data.index(b"\0", 20)].decode(errors="replace") not in self._channels:
                self._skipped[key[0]] = key[1]
        if self._skipped.get(key[0]) != key[1]:
            super()._take_fragment(data, key)


class Camera:
    """Recorded messages again and again, with sequence numbers that go on."""

    def __init__(self, messages):
        self._messages = [bytearray(m) for m in messages]
        self.seq = 0

    def next(self):
        message = self._messages[self.seq % len(self._messages)]
        struct.pack_into(">qq", message, 8, 1_000_000 + self.seq, self.seq)
        self.seq += 1
        return bytes(message)


class Process:
    """What the kernel says of a process."""

    def __init__(self, pid):
        self._folder = pathlib.Path(f"/proc/{pid}")

    def rss_bytes(self):
        return int((self._folder / "statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    def threads(self):
        return len(list((self._folder / "task").iterdir()))

    def descriptors(self):
        return len(list((self._folder / "fd").iterdir()))


class Trial(TrafficTest):
    """A test with a daemon under load."""

    def record_messages(self, count, kind="depth", width=640):
        """Simulated frames as messages, as bytes."""
        return [self.encoded(frame) for frame in self.record_frames(count, kind=kind, width=width)]

    def listen(self, use, channels, address="127.0.0.1"):
        listener = Listener(use, channels, address)
        self.addCleanup(listener.close)
        return listener

    def send_paced(self, listener, channel, data):
        """When every receiver has taken what came before: the kernel has no reason to drop anything."""
        wait_until(lambda: (listener.receive(0), waiting_bytes() == 0)[1], "the receivers")
        listener.publish(channel, data)

    def receive_until(self, listener, moment):
        while (left := moment - time.monotonic()) > 0:
            listener.receive(min(left, 0.1))
