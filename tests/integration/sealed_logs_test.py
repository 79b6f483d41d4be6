# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Logs of signed clouds: opened with the key however old they are, and told what is missing without."""
import json
import signal

from event_logs import read_log, write_log
from harness import CLOUDS, TYPES, GraspdTest, run_tests, wait_until
from sealing import Sealer

LISTS = TYPES["handle_list_t"]
REFUSED = LISTS.constants["REFUSED"]
FRAMES = 6


class SealedLogs(GraspdTest):
    def setUp(self):
        super().setUp()
        self.key_file = self.folder / "key"
        self.run_program("graspd-keygen", self.key_file)
        self.sealer = Sealer.from_file(self.key_file)
        plain = self.folder / "plain.log"
        self.run_program("graspd-simulate", "--log", plain, "--frames", FRAMES, "--type", "depth", "--width", 160,
                         "--new-scene-every", 1)
        self.plain = read_log(plain)
        self.want = [e.data for e in read_log(self.replay(plain, output="plain.out"))]
        # Signed when they were recorded, in 2023, and each with the number of the first.
        self.sealed = [e._replace(data=self.sealer.seal(CLOUDS, e.data, utime=e.utime, seq=1)) for e in self.plain]
        self.log = self.folder / "sealed.log"
        write_log(self.log, self.sealed)

    def replay(self, log, *options, output="out.log", code=0):
        self.last = self.run_program("graspd-replay", log, "-o", self.folder / output, "--overwrite", *options, code=code)
        return self.folder / output

    def statuses(self, log):
        return [LISTS.decode(e.data).status for e in read_log(log)]

    def test_with_the_key_they_are_as_if_they_were_not_signed(self):
        self.assertEqual([e.data for e in read_log(self.replay(self.log, "--key", self.key_file))], self.want)
        self.assertNotIn("signed", self.last.err)
        config = self.write_config(f'authentication: {{key_file: "{self.key_file}"}}\n')
        self.assertEqual([e.data for e in read_log(self.replay(self.log, "--config", config))], self.want)

    def test_without_the_key_it_says_what_is_needed(self):
        self.assertEqual(self.statuses(self.replay(self.log)), [REFUSED] * FRAMES)
        self.assertIn("signed clouds (sealed_t) are refused without the key that opens them: --key FILE", self.last.err)
        self.assertIn(f"{FRAMES} clouds are signed and were refused", self.last.err)
        self.replay(self.log, "--key", self.folder / "none", code=1)

    def test_only_what_the_key_has_signed_is_taken(self):
        stranger = Sealer(bytes(32))
        changed = bytearray(self.sealed[2].data)
        changed[len(changed) // 2] ^= 1
        events = [self.plain[0], self.sealed[1], self.sealed[2]._replace(data=bytes(changed)),
                  self.sealed[3]._replace(data=stranger.seal(CLOUDS, self.plain[3].data)),
                  self.sealed[4]._replace(data=self.sealer.seal("OTHER", self.plain[4].data)), self.sealed[5]]
        write_log(self.log, events)
        output = self.replay(self.log, "--key", self.key_file)
        self.assertEqual([i for i, status in enumerate(self.statuses(output)) if status != REFUSED], [1, 5])
        self.assertEqual([e.data for e in read_log(output)][1::4], self.want[1::4])

    def test_shards_open_them_too(self):
        plan = self.folder / "plan"
        mixed = self.plain[:3] + self.sealed[3:]
        write_log(self.log, mixed)
        self.run_program("graspd-replay", "plan", self.log, "-o", plan, "--shards", 2, "--key", self.key_file)
        frames = [shard["frames"] for shard in json.loads((plan / "plan.json").read_text(encoding="utf-8"))["shards"]]
        self.assertEqual(frames, [3, 3])  # a signed image is as much work as one that is not
        for number in range(2):
            self.run_program("graspd-replay", "shard", plan, number)
        self.run_program("graspd-replay", "merge", plan, "-o", self.folder / "merged.log")
        self.assertEqual((self.folder / "merged.log").read_bytes(),
                         self.replay(self.log, "--key", self.key_file).read_bytes())

    def test_pictures_of_the_worst_frames(self):
        before = self.replay(self.log, "--key", self.key_file, output="before.log")
        config = self.write_config("detect: {smoothness: {theta_low_deg: 0.5, theta_high_deg: 1}}\n")
        after = self.replay(self.log, "--key", self.key_file, "--config", config, output="after.log")
        for options, pictures in ((["--key", self.key_file], True), ([], False)):
            report = self.folder / f"report{pictures}"
            self.run_program("graspd-compare", before, after, "-o", report, "--clouds", self.log, *options)
            self.assertEqual(bool(list(report.glob("*.png"))), pictures)

    def test_drawn_with_the_key(self):
        pictures = [self.folder / name for name in ("sealed.png", "plain.png")]
        # Of equal names: a picture's title names the log.
        for folder, events in (("signed", self.sealed), ("open", self.plain)):
            (self.folder / folder).mkdir()
            write_log(self.folder / folder / "a.log", events)
        for path, (folder, options) in zip(pictures, (("signed", ["--key", self.key_file]), ("open", []))):
            self.run_program("graspd-draw", self.folder / folder / "a.log", "--frame", 2, "-o", path, *options)
        self.assertEqual(pictures[0].read_bytes(), pictures[1].read_bytes())
        closed = self.run_program("graspd-draw", self.folder / "signed/a.log", "-o", pictures[0], code=1)
        self.assertIn("--key FILE opens them", closed.err)

    def test_played_with_the_key_they_are_sent_open(self):
        bus = self.open_bus()
        for options, want in ((["--key", self.key_file], self.plain), ([], self.sealed)):
            bus.messages.clear()
            player = self.start("graspd-replay", "play", self.log, "--speed", 100, *options)
            wait_until(lambda: (bus.receive(0.02), len(bus.messages) >= FRAMES)[1], "the messages")
            self.assertEqual([data for channel, data in bus.messages if channel == CLOUDS], [e.data for e in want])
            player.stop(signal.SIGINT)


if __name__ == "__main__":
    run_tests()
