# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""graspd-compare: equal runs are equal, a planted regression is found and its worst frames are named."""
import csv

from event_logs import read_log, write_log
from harness import TYPES, GraspdTest, run_tests

LISTS = TYPES["handle_list_t"]


class Compare(GraspdTest):
    def setUp(self):
        super().setUp()
        self.clouds = self.folder / "in.log"
        self.run_program("graspd-simulate", "--log", self.clouds, "--frames", 8, "--type", "depth", "--width", 320,
                         "--new-scene-every", 1)
        self.before = self.replay("before.log")

    def replay(self, name, *options):
        self.run_program("graspd-replay", self.clouds, "-o", self.folder / name, *options)
        return self.folder / name

    def compare(self, after, *options, code=0):
        self.report = self.folder / "report"
        self.last = self.run_program("graspd-compare", self.before, after, "-o", self.report, *options, code=code)
        with (self.report / "frames.csv").open(encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_equal_runs(self):
        rows = self.compare(self.before, "--max-worse", 0)
        self.assertEqual({(r["lost"], r["gained"], r["net_loss"]) for r in rows}, {("0", "0", "0.000000")})
        self.assertIn("8 frames: 0 worse, 0 better, 8 the same to the bit", self.last.err)

    def test_a_planted_regression_in_two_frames(self):
        events = read_log(self.before)
        for number in (2, 5):
            message = LISTS.decode(events[number].data)
            for handle in message.handles:
                handle.score *= 0.5 if number == 2 else 0.2
            if number == 5:
                message.handles = message.handles[:1]
                message.num_handles = len(message.handles)
            events[number] = events[number]._replace(data=LISTS.encode(**vars(message)))
        after = self.folder / "after.log"
        write_log(after, events)
        rows = self.compare(after, "--clouds", self.clouds, "--max-worse", 0.2, code=1)
        worst = sorted(rows, key=lambda r: -float(r["net_loss"]))[:2]
        self.assertEqual([r["frame"] for r in worst], ["5", "2"])
        report = (self.report / "report.md").read_text(encoding="utf-8")
        listed = [line.split("|")[2].strip() for line in report.split("got worst")[1].splitlines()
                  if line.startswith("|")][2:]
        self.assertEqual(listed, ["5", "2"])
        for name in ("frame-000005-before.png", "frame-000005-after.png", "frame-000002-after.png"):
            self.assertIn(name, report)
            self.assertIn(name, (self.report / "report.html").read_text(encoding="utf-8"))
            self.assertEqual((self.report / name).read_bytes()[:4], b"\x89PNG")
        self.assertIn("6 the same to the bit", self.last.err)

    def test_a_changed_threshold_is_found(self):
        config = self.write_config("detect: {smoothness: {theta_low_deg: 0.5, theta_high_deg: 1}}\n")
        after = self.replay("after.log", "--config", config)
        self.compare(after, "--max-worse", 0.1, code=1)
        by_frame = {r["frame"]: float(r["net_loss"]) for r in self.compare(after)}
        report = (self.report / "report.md").read_text(encoding="utf-8")
        listed = [line.split("|")[2].strip() for line in report.split("got worst")[1].splitlines()
                  if line.startswith("|")][2:]
        worse = sorted((f for f in by_frame if by_frame[f] > 0.05), key=lambda f: -by_frame[f])
        self.assertGreater(len(worse), 0)
        self.assertEqual(sorted(listed), sorted(worse[:10]))
        self.assertEqual([by_frame[f] for f in listed], [by_frame[f] for f in worse[:10]])
        # What it lost comes back the other way round.
        self.before, before = after, self.before
        self.assertIn(f" {len(worse)} better", (self.compare(before), self.last)[1].err)

    def table(self, log):
        path = log.with_suffix(".parquet")
        self.run_program("graspd-replay", "table", log, "-o", path)
        return path

    def test_tables_are_as_good_as_logs(self):
        config = self.write_config("detect: {smoothness: {theta_low_deg: 0.5, theta_high_deg: 1}}\n")
        logs = self.before, self.replay("after.log", "--config", config, "--times")
        want = self.compare(logs[1], "--clouds", self.clouds)
        pictures = {p.name: p.read_bytes() for p in self.report.glob("*.png")}
        tables = [self.table(log) for log in logs]
        for log in logs:
            log.rename(log.with_suffix(".kept"))  # nothing but the tables is needed
        logs = [log.with_suffix(".kept") for log in logs]
        for runs in (tables, (tables[0], logs[1]), (logs[0], tables[1])):
            self.before = runs[0]
            got = self.compare(runs[1], "--clouds", self.clouds)
            self.assertEqual(len(got), len(want))
            for ours, theirs in zip(got, want):
                self.assertEqual({k: v for k, v in ours.items() if k not in ("best_before", "best_after", "net_loss")},
                                 {k: v for k, v in theirs.items() if k not in ("best_before", "best_after", "net_loss")})
                for column in ("best_before", "best_after", "net_loss"):
                    self.assertAlmostEqual(float(ours[column]), float(theirs[column]), delta=2e-6)
            self.assertEqual({p.name for p in self.report.glob("*.png")}, set(pictures))
        self.before = tables[0]
        self.compare(logs[0])
        self.assertIn("8 the same to the bit", self.last.err)
        tables[0].with_suffix(".frames.parquet").write_bytes(b"PAR1PAR1PAR1")
        self.run_program("graspd-compare", tables[0], logs[1], code=1)

    def test_frames_of_one_run_alone_and_other_logs(self):
        after = self.replay("part.log", "--frames", "2:7")
        self.assertEqual(len(self.compare(after)), 5)
        self.assertIn("answered before only | 3", (self.report / "report.md").read_text(encoding="utf-8"))
        self.compare(self.clouds, code=1)
        self.run_program("graspd-compare", self.before, self.folder / "none.log", code=1)


if __name__ == "__main__":
    run_tests()
