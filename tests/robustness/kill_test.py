# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""graspd-log is killed at random moments: its log holds every event up to the last complete one, whole and in order."""
import random
import struct
import threading

from trial import Bus, Trial, listening_sockets, options_of, run_trial, table, time, wait_until

OPTIONS = options_of(__doc__, kills=15, seed=1, longest_ms=40.0)
SYNC, HEADER = 0xEDA1DA01, struct.Struct(">Iqqii")
CHANNEL = "KILLED_LOG"


def read_log(data):
    """(payloads of the complete events, bytes of the incomplete one at the end); raises ValueError for anything else."""
    events, at = [], 0
    while len(data) - at >= HEADER.size:
        sync, number, _, channel_bytes, data_bytes = HEADER.unpack_from(data, at)
        if sync != SYNC or number != len(events):
            raise ValueError(f"no event {len(events)} at byte {at}")
        end = at + HEADER.size + channel_bytes + data_bytes
        if end > len(data):
            break
        if data[at + HEADER.size:end - data_bytes].decode() != CHANNEL:
            raise ValueError(f"another channel at byte {at}")
        events.append(data[end - data_bytes:end])
        at = end
    return events, len(data) - at


def payload(number):
    """Tells its number, and is as long as only this number's is."""
    return struct.pack(">q", number) + bytes(random.Random(number).randrange(150_000))


class Kill(Trial):
    def setUp(self):
        super().setUp()
        self.running = True
        self.bus = Bus()
        self.addCleanup(self.bus.close)
        self.sender = threading.Thread(target=self.send_for_ever)
        self.sender.start()
        self.addCleanup(self.sender.join)
        self.addCleanup(setattr, self, "running", False)

    def send_for_ever(self):
        number = 0
        while self.running:
            self.bus.publish(CHANNEL, payload(number))
            number += 1
            time.sleep(0.0005)

    def kill_one(self, number, moment):
        """The log's bytes."""
        path = self.folder / f"log{number}"
        before = listening_sockets()
        logger = self.start("graspd-log", "--channel", CHANNEL, "--min-free", 0, path)
        wait_until(lambda: listening_sockets() > before or logger.process.poll() is not None, "graspd-log to listen")
        if number % 3:  # else while it starts
            wait_until(lambda: path.exists() and path.stat().st_size > 0 or logger.process.poll() is not None, "a log")
        time.sleep(moment)
        self.assertIsNone(logger.process.poll(), logger.err)
        logger.kill()
        data = path.read_bytes() if path.exists() else b""
        path.unlink(missing_ok=True)
        for end in (*self.folder.glob("*.out"), *self.folder.glob("*.err")):
            end.unlink()
        return data

    def test_kill(self):
        moments = random.Random(OPTIONS.seed)
        events = cut = empty = unreadable = 0
        start = time.monotonic()
        for number in range(OPTIONS.kills):
            data = self.kill_one(number, moments.random() * OPTIONS.longest_ms / 1000)
            try:
                got, rest = read_log(data)
                numbers = [struct.unpack_from(">q", event)[0] for event in got]
                if numbers != sorted(set(numbers)) or any(e != payload(n) for e, n in zip(got[-2:], numbers[-2:])):
                    raise ValueError("events that were never sent")
            except ValueError as error:
                print(f"log {number}: {error}")
                unreadable += 1
                continue
            events += len(got)
            cut += rest > 0
            empty += not data
        table(("trial", "kill"), ("SIGKILLs", OPTIONS.kills), ("length", f"{time.monotonic() - start:.0f} s"),
              ("events in the logs", events), ("logs cut inside an event", cut), ("logs still empty", empty),
              ("unreadable", unreadable))
        self.assertEqual(unreadable, 0)
        self.assertGreater(events, 0)


if __name__ == "__main__":
    run_trial()
