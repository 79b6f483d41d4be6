# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""graspd-replay: the daemon's answers, the same bytes for any threads and any interruption, from whole and damaged logs."""
import hashlib
import json
import os
import random
import re
import signal
import time

from event_logs import Event, event_bytes, read_log, write_log
from harness import CLOUDS, HANDLES, TYPES, GraspdTest, run_tests, wait_until

LISTS = TYPES["handle_list_t"]


def without_times(data):
    """A handle list as bytes, with what is measured set to 0."""
    message = LISTS.decode(data)
    message.latency = 0
    for stage in message.stages:
        stage.milliseconds = 0
    return LISTS.encode(**vars(message))


class ReplayTest(GraspdTest):
    def simulate_log(self, frames, *options, width=128, rate=10, name="in.log"):
        path = self.folder / name
        self.run_program("graspd-simulate", "--log", path, "--frames", frames, "--type", "depth", "--width", width,
                         "--new-scene-every", 2, "--rate", rate, *options)
        return path

    def replay(self, *arguments, output="out.log", code=0):
        path = self.folder / output
        self.last = self.run_program("graspd-replay", *arguments, "-o", path, code=code)
        return path


class SameAsTheDaemon(ReplayTest):
    def record(self, bus, config):
        """A log of clouds and answers of the live daemon."""
        log = self.folder / "live.log"
        logger = self.start_listening("graspd-log", "--min-free", 0, log)
        self.probe(bus, "PROBE", b"", lambda: log.stat().st_size > 0, "the first event in the log")
        self.start_daemon(bus, config)
        bus.messages.clear()
        self.run_program("graspd-simulate", "--frames", 8, "--rate", 8, "--width", 320, "--new-scene-every", 1,
                         "--type", "depth")
        bus.publish(CLOUDS, b"\0\1\2\3\4\5\6\7 is no cloud")
        answers = self.await_answers(bus, 9)
        self.assertEqual(len(answers), 9)
        wait_until(lambda: log.read_bytes().count(HANDLES.encode() + LISTS.fingerprint) == 9,
                   "the answers in the log")
        logger.stop(signal.SIGINT)
        return log

    def test_the_same_bits_as_the_live_daemon(self):
        config = self.write_config("detect: {smoothness: {theta_low_deg: 5}}\nsources:\n  - name: camera\n"
                                   "    channel: GRASPD_CLOUD\n    policy: all\n    gripper: robotiq_2f_85\n"
                                   "    sensor_pose: {frame_name: base, position_m: [0.1, 0.2, 0.3], rpy_rad: [3, 0, 1]}\n")
        log = self.record(self.open_bus(), config)
        events = read_log(log)
        live = {LISTS.decode(e.data).seq: without_times(e.data) for e in events if e.channel == HANDLES}
        clouds = [e for e in events if e.channel == CLOUDS]
        output = read_log(self.replay(log, "--config", config))
        self.assertEqual([e.utime for e in output], [e.utime for e in clouds])
        replayed = {LISTS.decode(e.data).seq: e.data for e in output}
        self.assertEqual(set(live), {-1, *range(8)})
        self.assertEqual(replayed, live)
        self.assertTrue(any(LISTS.decode(data).handles for data in live.values()))


class Output(ReplayTest):
    def test_any_number_of_threads_gives_the_same_bytes(self):
        log = self.simulate_log(12)
        one = self.replay(log, "--threads", 1, "--keep", ".*", output="1.log").read_bytes()
        for threads in (2, 5):
            self.assertEqual(self.replay(log, "--threads", threads, "--keep", ".*", output=f"{threads}.log").read_bytes(),
                             one)
        receipt = json.loads((self.folder / "1.log.receipt").read_text(encoding="utf-8"))
        self.assertEqual(receipt["sha256"], hashlib.sha256(one).hexdigest())
        self.assertEqual((receipt["state"]["frames"], receipt["state"]["kept"]), (12, 12))
        self.assertEqual(sorted(p.name for p in self.folder.glob("1.log*")), ["1.log", "1.log.receipt"])

    def test_kept_channels_stand_before_their_answers(self):
        clouds = read_log(self.simulate_log(4))
        others = [Event(0, clouds[1].utime + 1, "NOTES", b"hello"), Event(0, clouds[1].utime + 2, HANDLES, b"old")]
        events = clouds[:2] + others + clouds[2:]
        log = self.folder / "mixed.log"
        write_log(log, [event._replace(number=i) for i, event in enumerate(events)])
        output = read_log(self.replay(log, "--keep", ".*"))
        self.assertEqual([e.channel for e in output],
                         [CLOUDS, HANDLES, CLOUDS, HANDLES, "NOTES", CLOUDS, HANDLES, CLOUDS, HANDLES])
        self.assertEqual([e.data for e in output if e.channel == CLOUDS], [e.data for e in clouds])
        self.assertEqual({e.channel for e in read_log(self.replay(log, "--keep", "NO.*", output="notes.log"))},
                         {"NOTES", HANDLES})

    def test_parts_of_a_log(self):
        log = self.simulate_log(10)
        lists = [e.data for e in read_log(self.replay(log, output="all.log"))]
        start = read_log(log)[0].utime * 1e-6
        for options, first, end in ((["--frames", "3:6"], 3, 6), (["--frames", "8:"], 8, 10),
                                    (["--from", "0.25", "--to", "0.7"], 3, 7),
                                    (["--from", f"@{start + 0.5:.6f}"], 5, 10),
                                    (["--from", "0.1", "--frames", ":4"], 1, 4)):
            with self.subTest(options):
                part = self.replay(log, *options, "--overwrite", output="part.log")
                self.assertEqual([e.data for e in read_log(part)], lists[first:end])

    def test_times_are_found_without_reading_the_log(self):
        # 41 seconds between frames of 150 kB; the second of two logs.
        stem = self.simulate_log(120, "--log-part", 10, "--scene", "empty", width=320, rate=1 / 41, name="long")
        logs = sorted(self.folder.glob("long.*"))
        self.assertEqual(len(logs), 2)
        for options, frames in ((["--from", 41 * 100, "--to", 41 * 103 - 1], 3), (["--from", 41 * 118 + 1], 1),
                                (["--to", "41.5"], 2), (["--from", 41 * 130], 0)):
            with self.subTest(options):
                found = self.replay(stem, *options, "--keep", ".*", "--overwrite", output="found.log")
                looked_at, of = map(float, re.search(r"([\d.]+) of ([\d.]+) MB are looked at", self.last.err).groups())
                self.assertLess(looked_at, 3)
                self.assertGreater(of, 15)
                scanned = self.replay(stem, *options, "--keep", ".*", "--scan", "--overwrite", output="scanned.log")
                self.assertNotIn("looked at", self.last.err)
                self.assertEqual(found.read_bytes(), scanned.read_bytes())
                self.assertEqual(len(read_log(found)), 2 * frames)
                # The same run, whatever way it finds its place.
                self.replay(stem, *options, "--keep", ".*", "--scan", "--resume", output="found.log")
                self.assertIn("complete already", self.last.err)

    def test_frames_are_found_with_an_index(self):
        stem = self.simulate_log(120, "--log-part", 10, "--scene", "empty", width=320, name="long")
        index = self.folder / "frames.json"
        for number, frames in enumerate(("100:103", "118:", ":2", "130:")):
            with self.subTest(frames):
                found = self.replay(stem, "--frames", frames, "--index", index, output=f"found{number}.log")
                self.assertEqual("index of the frames written" in self.last.err, number == 0)
                scanned = self.replay(stem, "--frames", frames, output=f"scanned{number}.log")
                self.assertEqual(found.read_bytes(), scanned.read_bytes())
        self.assertLess(index.stat().st_size, 1000)
        index.write_text("{}", encoding="utf-8")
        self.replay(stem, "--frames", "1:2", "--index", index, output="no.log", code=1)
        self.assertIn("not an index", self.last.err)
        self.replay(stem, "--index", index, output="no.log", code=2)

    def test_where_times_go_backwards_all_is_read(self):
        events = read_log(self.simulate_log(6))
        # The clock is put back by an hour between frames 2 and 3.
        later = [event._replace(utime=event.utime + 3600_000_000) for event in events[:3]]
        log = self.folder / "stepped.log"
        write_log(log, later + events[3:])
        found = self.replay(log, "--from", f"@{later[1].utime * 1e-6:.6f}", "--keep", CLOUDS)
        self.assertIn("times go backwards", self.last.err)
        self.assertEqual([e.data for e in read_log(found) if e.channel == CLOUDS], [e.data for e in later[1:]])

    def test_an_output_is_not_replaced_unasked(self):
        log = self.simulate_log(2)
        output = self.replay(log)
        before = output.read_bytes()
        self.replay(log, code=1)
        self.replay(log, "--gripper", "robotiq_2f_85", "--resume", code=1)
        self.assertEqual(output.read_bytes(), before)
        self.replay(log, "--resume")
        self.assertIn("complete already", self.last.err)
        self.replay(log, "--gripper", "robotiq_2f_85", "--overwrite")
        self.assertNotEqual(output.read_bytes(), before)

    def test_wrong_usage(self):
        log = self.simulate_log(1)
        for options in (["--keep", "("], ["--frames", "3"], ["--from", "soon"], ["--config", "/nowhere"]):
            self.replay(log, *options, code=2)
        self.replay(self.folder / "none.log", code=1)
        self.replay(log, output="no/such/folder/out.log", code=1)


class Stopped(ReplayTest):
    def kill_once(self, log, rng):
        """Kills a run -9 somewhere; whether it was still running."""
        part = self.folder / "out.log.part"
        size = part.stat().st_size if part.exists() else 0
        program = self.start("graspd-replay", log, "-o", self.folder / "out.log", "--resume", "--checkpoint", 0,
                             "--keep", CLOUDS, "--threads", 2)
        grown = size + rng.randint(0, 60_000)
        wait_until(lambda: program.process.poll() is not None or (part.exists() and part.stat().st_size >= grown),
                   "some output")
        time.sleep(rng.uniform(0, 0.01))
        program.process.kill()
        return program.process.wait() == -signal.SIGKILL

    def test_killed_at_20_moments_it_gives_the_same_bytes(self):
        log = self.simulate_log(40)
        want = self.replay(log, "--keep", CLOUDS, output="whole.log").read_bytes()
        rng, output, kills = random.Random(8), self.folder / "out.log", 0
        while kills < 20:
            if self.kill_once(log, rng):
                kills += 1
            if output.exists():  # complete before the kill, or in spite of it: begin another one
                self.assertEqual(output.read_bytes(), want)
                output.unlink()
        self.replay(log, "--resume", "--keep", CLOUDS)
        self.assertEqual(output.read_bytes(), want)
        self.assertEqual(sorted(p.name for p in self.folder.glob("out.log*")), ["out.log", "out.log.receipt"])

    def stop_at_work(self, log, *options):
        """A run that stands still (SIGSTOP) with some of its output written, however quick it is."""
        output, part = self.folder / "out.log", self.folder / "out.log.part"
        while True:
            program = self.start("graspd-replay", log, "-o", output, *options)
            wait_until(lambda p=program.process: p.poll() is not None or (part.exists() and part.stat().st_size > 0),
                       "some output")
            if program.process.poll() is None:
                program.process.send_signal(signal.SIGSTOP)
                os.waitid(os.P_PID, program.process.pid, os.WSTOPPED | os.WEXITED | os.WNOWAIT)
                if not output.exists():
                    return program
                program.process.send_signal(signal.SIGCONT)
            self.assertEqual(program.wait(), 0, program.err)  # done before it could be stopped: once more
            for path in self.folder.glob("out.log*"):
                path.unlink()

    def test_interrupted_it_says_how_to_go_on(self):
        log = self.simulate_log(60)
        program = self.stop_at_work(log, "--checkpoint", 0)
        program.process.send_signal(signal.SIGINT)
        program.process.send_signal(signal.SIGCONT)
        self.assertEqual(program.wait(), 1, program.err)
        self.assertIn("--resume", program.err)
        self.replay(log, code=1)  # neither resumed nor overwritten
        self.replay(log, "--gripper", "robotiq_2f_85", "--resume", code=1)  # another run's
        want = self.replay(log, output="whole.log").read_bytes()
        self.assertEqual(self.replay(log, "--resume").read_bytes(), want)

    def test_two_writers_of_one_file(self):
        log = self.simulate_log(60)
        first = self.stop_at_work(log)
        self.replay(log, "--resume", code=1)
        self.assertIn("another process", self.last.err)
        first.process.send_signal(signal.SIGCONT)
        self.assertEqual(first.wait(), 0, first.err)


class Damaged(ReplayTest):
    def test_a_damaged_log_costs_the_damaged_events_alone(self):
        log = self.simulate_log(6)
        events = [event_bytes(e) for e in read_log(log)]
        want = [e.data for e in read_log(self.replay(log, output="whole.log"))]
        torn = events[1][:5] + b"\xff" + events[1][6:]
        torn = b"\0" + torn[1:]  # its sync word
        log.write_bytes(events[0] + torn + events[2] + b"rubbish" * 50 + events[3] + events[4] + events[5][:-9])
        output = self.replay(log, "--keep", "NONE")
        self.assertEqual([e.data for e in read_log(output)], [want[i] for i in (0, 2, 3, 4)])
        self.assertIn(f"{len(torn) + 350 + len(events[5]) - 9} bytes", self.last.err)

    def test_rotated_logs_are_one(self):
        whole = self.replay(self.simulate_log(8)).read_bytes()
        stem = self.folder / "parts" / "in"
        stem.parent.mkdir()
        self.simulate_log(8, "--log-part", 0.06, name="parts/in")
        self.assertGreater(len(list(stem.parent.iterdir())), 2)
        for number, argument in enumerate((stem, stem.parent)):
            self.assertEqual(self.replay(argument, output=f"{number}.log").read_bytes(), whole)

    def test_bytes_of_strangers(self):
        rng = random.Random(3)
        noise = self.folder / "noise"
        noise.write_bytes(rng.randbytes(100_000))
        self.assertEqual(read_log(self.replay(noise)), [])
        cloud = read_log(self.simulate_log(1))[0]
        hostile = [cloud.data[:rng.randrange(len(cloud.data))] for _ in range(20)]
        write_log(noise, [Event(i, i, CLOUDS, data) for i, data in enumerate(hostile)])
        lists = [LISTS.decode(e.data) for e in read_log(self.replay(noise, output="refused.log"))]
        self.assertEqual([m.status for m in lists], [LISTS.constants["REFUSED"]] * 20)


if __name__ == "__main__":
    run_tests()
