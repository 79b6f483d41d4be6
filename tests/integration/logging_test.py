# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""graspd-log: complete, readable by LCM's own player, in parts of a size, and clear about a disk it cannot write to."""
import shutil
import signal
import struct
import subprocess
import unittest

from event_logs import read_log
from harness import CLOUDS, HANDLES, STATUS, run_tests, wait_until
from traffic import TrafficTest

PROBE = "GRASPD_PROBE"


class Logging(TrafficTest):
    def log_files(self):
        return sorted((self.folder / "log").glob("record*"))

    def record(self, messages, *options):
        """The events that graspd-log writes of these (channel, bytes), file by file."""
        bus = self.open_bus()
        (self.folder / "log").mkdir()
        logger = self.start_listening("graspd-log", "--channel", "GRASPD_.*", "--min-free", 0, *options,
                                      self.folder / "log/record")
        self.probe(bus, PROBE, b"", lambda: self.log_files()[0].stat().st_size > 0, "the first event in the log")
        for channel, data in messages + [(PROBE, b"end")]:
            self.publish_paced(bus, channel, data)
        end = PROBE.encode() + b"end"
        wait_until(lambda: any(f.read_bytes().endswith(end) for f in self.log_files()), "the last event in the log")
        self.assertEqual(logger.stop(signal.SIGINT)[0], 0, logger.err)
        return [[(event.channel, event.data) for event in read_log(path) if event.channel != PROBE]
                for path in self.log_files()]

    def test_a_log_is_complete_and_leaves_out_other_channels(self):
        frame = self.record_frames(1)[0]
        messages = [(CLOUDS, self.with_seq(frame, seq)) for seq in range(5)] + [(HANDLES, b"x" * 40), (STATUS, b"")]
        files = self.record([("OTHER", b"y" * 100)] + messages)
        self.assertEqual(len(files), 1)
        self.assertEqual(files[0], messages)

    def test_rotation_by_size(self):
        messages = [(CLOUDS, struct.pack(">q", i) + bytes(100_000)) for i in range(40)]
        files = self.record(messages, "--max-size", 1)
        self.assertGreater(len(files), 3)
        self.assertEqual([event for events in files for event in events], messages)
        for path in self.log_files():
            self.assertLess(path.stat().st_size, 1_000_000)

    @unittest.skipUnless(shutil.which("lcm-logplayer"), "lcm-logplayer is not installed")
    def test_lcm_plays_it_back(self):
        messages = [(CLOUDS, struct.pack(">q", i) * 10) for i in range(20)]
        self.record(messages)
        bus = self.open_bus()
        player = subprocess.run(["lcm-logplayer", "--speed=10", str(self.log_files()[0])], capture_output=True,
                                text=True, check=False)
        self.assertEqual(player.returncode, 0, player.stderr)
        wait_until(lambda: (bus.receive(0.02), len(bus.on(CLOUDS)) >= 20)[1], "the replayed messages")
        self.assertEqual([m for m in bus.messages if m[0] == CLOUDS], messages)

    def mount(self, options):
        folder = self.folder / "disk"
        folder.mkdir()
        subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", str(folder)], check=True)
        self.addCleanup(subprocess.run, ["umount", str(folder)], check=True)
        return folder

    def assert_one_line(self, program, folder):
        """It ends with 1, and one line says what is wrong with the folder."""
        self.assertEqual(program.wait(), 1, program.err)
        errors = [line for line in program.err.splitlines() if str(folder) in line]
        self.assertEqual(len(errors), 1, program.err)

    def test_a_folder_that_cannot_be_written_to(self):
        file = self.folder / "a_file"
        file.touch()
        for folder in (self.mount("ro"), file, file / "below"):
            with self.subTest(folder=folder):
                self.assert_one_line(self.start("graspd-log", folder / "record"), folder)

    def record_until_it_ends(self, disk, min_free_mb):
        """Sends messages until graspd-log has had enough."""
        bus = self.open_bus()
        logger = self.start_listening("graspd-log", "--min-free", min_free_mb, disk / "record")

        def ended():
            bus.publish(CLOUDS, bytes(50_000))
            return logger.process.poll() is not None
        wait_until(ended, "graspd-log to notice that there is no room")
        self.assert_one_line(logger, disk)
        return [(event.channel, event.data) for path in disk.glob("record*") for event in read_log(path)]

    def test_a_full_disk(self):
        self.assertGreater(len(self.record_until_it_ends(self.mount("size=1m"), 0)), 5)

    def test_a_disk_below_the_floor(self):
        self.assertEqual(self.record_until_it_ends(self.mount("size=8m"), 100), [])


if __name__ == "__main__":
    run_tests()
