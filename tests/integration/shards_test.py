# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""graspd-replay plan, shard, missing, merge, play: all frames once, the bytes of a local run, what is wrong is told."""
import json
import signal
import subprocess
import time

from event_logs import event_bytes, read_log
from harness import BIN, CLOUDS, GraspdTest, run_tests, wait_until


class Shards(GraspdTest):
    def setUp(self):
        super().setUp()
        self.plan = self.folder / "plan"
        self.logs = []
        for seed in (1, 2, 3):
            path = self.folder / f"in{seed}.log"
            self.run_program("graspd-simulate", "--log", path, "--frames", 5 * seed, "--type", "depth", "--width", 128,
                             "--new-scene-every", 2, "--seed", seed)
            self.logs.append(path)
        events = [event_bytes(e) for e in read_log(self.logs[1])]
        self.logs[1].write_bytes(b"".join(events[:4]) + b"rubbish" * 9 + b"".join(events[4:]))

    def make_plan(self, shards, *options):
        made = self.run_program("graspd-replay", "plan", *self.logs, "-o", self.plan, "--shards", shards, *options)
        return int(made.out)

    def shard(self, number, code=0, **options):
        return self.run_program("graspd-replay", "shard", self.plan, *([] if number is None else [number]), code=code,
                                **options)

    def missing(self):
        return self.run_program("graspd-replay", "missing", self.plan).out.strip()

    def merge(self, code=0):
        return self.run_program("graspd-replay", "merge", self.plan, "-o", self.folder / "merged.log", "--overwrite",
                                code=code)

    def local_run(self, *options):
        path = self.folder / "local.log"
        self.run_program("graspd-replay", *self.logs, "-o", path, "--overwrite", *options)
        return path.read_bytes()

    def test_merged_shards_are_the_local_run(self):
        for shards, made in ((1, 1), (4, 4), (500, 30)):
            with self.subTest(shards):
                self.plan = self.folder / f"plan{shards}"
                self.assertEqual(self.make_plan(shards, "--keep", CLOUDS, "--gripper", "robotiq_2f_85"), made)
                for number in reversed(range(made)):
                    self.shard(number)
                self.assertEqual(self.missing(), "")
                self.merge()
                self.assertEqual((self.folder / "merged.log").read_bytes(),
                                 self.local_run("--keep", CLOUDS, "--gripper", "robotiq_2f_85"))
                receipt = json.loads((self.folder / "merged.log.receipt").read_text(encoding="utf-8"))
                self.assertEqual((receipt["state"]["frames"], receipt["state"]["skipped_bytes"]), (30, 63))

    def test_shards_are_of_equal_work(self):
        self.make_plan(5)
        plan = json.loads((self.plan / "plan.json").read_text(encoding="utf-8"))
        self.assertEqual([shard["frames"] for shard in plan["shards"]], [6] * 5)

    def test_tasks_are_idempotent_and_numbered_by_their_scheduler(self):
        self.make_plan(3)
        self.assertEqual(self.missing(), "0,1,2")
        self.shard(None, environment={"SLURM_ARRAY_TASK_ID": "1"})
        self.shard(None, environment={"JOB_COMPLETION_INDEX": "2"})
        self.assertEqual(self.missing(), "0")
        before = (self.plan / "shards/000001.log").stat().st_mtime_ns
        self.assertIn("complete already", self.shard(1).err)
        self.assertEqual((self.plan / "shards/000001.log").stat().st_mtime_ns, before)
        for number in (3, "x", None):
            self.shard(number, code=2)
        self.assertIn("shard 0: not done", self.merge(code=1).err)

    def test_what_is_wrong_is_told(self):
        self.make_plan(2)
        for number in (0, 1):
            self.shard(number)
        log = self.plan / "shards/000001.log"
        good = log.read_bytes()
        log.write_bytes(good[:-1] + bytes([good[-1] ^ 1]))
        self.assertIn("shard 1: not the bytes", self.merge(code=1).err)
        self.assertFalse((self.folder / "merged.log").exists())
        log.write_bytes(good[:100])
        self.assertEqual(self.missing(), "1")
        log.unlink()
        self.assertEqual(self.missing(), "1")
        self.shard(1)
        self.assertEqual(log.read_bytes(), good)
        self.merge()
        self.run_program("graspd-replay", "plan", *self.logs, "-o", self.plan, "--shards", 3, code=1)
        with self.logs[0].open("ab") as file:
            file.write(b"x")
        self.assertIn("has changed", self.shard(0, code=1).err)
        (self.plan / "plan.json").write_text('{"shards": 3}', encoding="utf-8")
        self.assertIn("not a plan", self.shard(0, code=1).err)


class Play(GraspdTest):
    def setUp(self):
        super().setUp()
        self.log = self.folder / "in.log"
        self.run_program("graspd-simulate", "--log", self.log, "--frames", 20, "--type", "depth", "--width", 64,
                         "--rate", 10)
        self.events = read_log(self.log)
        self.bus = self.open_bus()

    def received(self):
        self.bus.receive(0.02)
        return [data for channel, data in self.bus.messages if channel == CLOUDS]

    def play(self, *options):
        process = subprocess.Popen([str(BIN / "graspd-replay"), "play", str(self.log), *options], stdin=subprocess.PIPE,
                                   stderr=subprocess.DEVNULL, text=True)
        self.addCleanup(lambda: (process.poll() is None and process.kill(), process.wait(), process.stdin.close()))
        return process

    @staticmethod
    def tell(process, line):
        process.stdin.write(line + "\n")
        process.stdin.flush()

    def test_everything_in_its_rhythm(self):
        start = time.monotonic()
        process = self.play("--speed", "4")
        wait_until(lambda: len(self.received()) >= 20, "all messages")
        self.assertGreater(time.monotonic() - start, 0.9 * 1.9 / 4)
        self.assertEqual(process.wait(), 0)
        self.assertEqual(self.received(), [e.data for e in self.events])

    def test_pause_seek_and_quit(self):
        process = self.play("--paused", "--stay", "--speed", "1000")
        self.tell(process, "no such command")
        self.tell(process, "seek 1.45")
        self.tell(process, "play")
        wait_until(lambda: len(self.received()) >= 5, "the last five")
        self.tell(process, "pause")
        self.tell(process, "seek 0.75")
        self.tell(process, "speed 500")
        self.tell(process, "play")
        wait_until(lambda: len(self.received()) >= 5 + 12, "the last twelve")
        self.tell(process, "quit")
        self.assertEqual(process.wait(), 0)
        data = [e.data for e in self.events]
        self.assertEqual(self.received(), data[15:] + data[8:])

    def test_a_signal_ends_it_well(self):
        process = self.play("--paused")
        self.tell(process, "play")
        wait_until(self.received, "the first message")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), 0)


if __name__ == "__main__":
    run_tests()
