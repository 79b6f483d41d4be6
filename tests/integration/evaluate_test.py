# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""graspd-evaluate on simulated frames: figures from files, CSV and logs, comparison, and wrong input."""
import csv
import io
import json

from harness import GraspdTest, run_tests

FRAMES = 3


class Evaluate(GraspdTest):
    def setUp(self):
        super().setUp()
        self.frames = self.simulate(FRAMES)

    def figures(self, *arguments):
        """Everything that the program says, as JSON."""
        return json.loads(self.run_program("graspd-evaluate", "--format", "json", *arguments).out)

    def handles_file(self, name="handles.csv"):
        path = self.folder / name
        path.write_text(self.run_program("graspd-detect", "--format", "csv", self.frames).out, encoding="utf-8")
        return path

    def test_figures_of_detection(self):
        result = self.figures(self.frames)
        total = result["figures"][0]
        self.assertEqual(total["frames"], FRAMES)
        self.assertGreater(total["objects"], FRAMES)
        self.assertGreater(total["recall"], 0)
        self.assertGreater(total["precision"], 0.5)
        self.assertEqual(len(result["frames"]), FRAMES + 1)
        self.assertEqual(sum(row["objects"] for row in result["frames"][:-1]), total["objects"])
        self.assertEqual(sum(row["valid"] for row in result["frames"][:-1]), total["valid"])

    def test_a_file_of_handles_gives_the_same_figures(self):
        detected = self.figures(self.frames)["figures"][0]
        read = self.figures("--handles", self.handles_file(), self.frames)["figures"][0]
        for key in ("frames", "objects", "found", "handles", "valid", "best_of_frame"):
            self.assertEqual(detected[key], read[key], key)

    def test_a_comparison_with_itself_shows_no_difference(self):
        one = self.handles_file()
        result = self.figures("--compare", one, one, self.frames)
        self.assertEqual(result["differences"], [])
        self.assertEqual(len(result["figures"]), 2)

    def test_a_comparison_names_what_is_missing(self):
        one = self.handles_file()
        less = one.with_name("less.csv")
        lines = one.read_text(encoding="utf-8").splitlines(keepends=True)
        less.write_text("".join(lines[:2]), encoding="utf-8")
        result = self.figures("--compare", one, less, self.frames)
        self.assertEqual({row["only_in"] for row in result["differences"]}, {"handles.csv"})

    def test_every_format_has_the_same_tables(self):
        extras = ["--calibration", "--disturb", "--explain", "--category", "simulated=*", self.frames]
        tables = json.loads(self.run_program("graspd-evaluate", "-f", "json", *extras).out)
        self.assertEqual(set(tables), {"frames", "objects", "categories", "figures", "failures", "disturbances",
                                       "calibration", "invalid"})
        markdown = self.run_program("graspd-evaluate", *extras).out
        self.assertEqual(markdown.count("\n## ") + markdown.startswith("## "), len(tables))
        rows = list(csv.reader(io.StringIO(self.run_program("graspd-evaluate", "-f", "csv", *extras).out)))
        for name, table in tables.items():
            self.assertEqual(sum(row[:1] == [name] for row in rows), len(table), name)

    def test_graspable_objects_are_cached_in_a_file(self):
        found = self.run_program("graspd-evaluate", "--find-graspable", self.frames).out
        path = self.folder / "graspable.csv"
        path.write_text(found, encoding="utf-8")
        rows = list(csv.DictReader(io.StringIO(found)))
        graspable = sum(int(row["poses"]) >= 3 for row in rows)
        self.assertGreater(graspable, 0)
        total = self.figures("--graspable", path, self.frames)["figures"][0]
        self.assertEqual(total["objects"], graspable)

    def test_variants_are_rows_of_one_table(self):
        rows = self.figures("--summary", "--variants", "thresholds,clouds", self.frames)["figures"]
        self.assertEqual(rows[0]["run"], "graspd")
        self.assertEqual(len({row["run"] for row in rows}), 1 + 3 + 3)
        self.assertEqual({row["objects"] for row in rows}, {rows[0]["objects"]})

    def test_logs_with_their_answers_and_without(self):
        bus = self.open_bus()
        log = self.folder / "run.log"
        self.start_daemon(bus, self.write_config(
            "sources:\n  - name: camera\n    channel: GRASPD_CLOUD\n    policy: all\n"))
        logger = self.start_listening("graspd-log", "--channel", "GRASPD_(CLOUD|HANDLES|PROBE)", "--min-free", 0, log)
        self.probe(bus, "GRASPD_PROBE", b"", lambda: log.exists() and log.stat().st_size > 0, "the log's first event")
        self.run_program("graspd-publish", "--rate", 5, self.frames)
        self.await_answers(bus, FRAMES)
        self.probe(bus, "GRASPD_PROBE", b"end", lambda: log.read_bytes().endswith(b"end"), "the log's last event")
        self.assertEqual(logger.stop()[0], 0)
        logged, detected = self.figures(log)["figures"][0], self.figures("--detect", log)["figures"][0]
        self.assertGreater(logged["objects"], 0)
        self.assertEqual(logged, detected)
        cut = self.folder / "cut.log"
        cut.write_bytes(log.read_bytes()[:-2000])
        program = self.run_program("graspd-evaluate", cut, code=1)
        self.assertIn("cut.log", program.err)
        self.assertIn("## Figures", program.out)

    def test_wrong_use(self):
        for arguments in ([], [self.frames, "--handles", "a", "--detect"], [self.frames, "--variants", "none"],
                          [self.frames, "--category", "nothing"], [self.frames, "--format", "xml"]):
            program = self.run_program("graspd-evaluate", *arguments, code=2)
            self.assertEqual(program.out, "")
            self.assertEqual(program.err.strip().count("\n"), 0, program.err)

    def test_input_that_is_not_there_or_is_none(self):
        bad = self.folder / "bad.csv"
        bad.write_text("frame,px\na,1\n", encoding="utf-8")
        for arguments, part in (([self.folder / "none"], "no such file"),
                                (["--handles", bad, self.frames], "has no column `py`"),
                                ([bad], "neither a PCD nor a PLY")):
            program = self.run_program("graspd-evaluate", *arguments, code=1)
            self.assertEqual(program.out, "")
            self.assertIn(part, program.err)


if __name__ == "__main__":
    run_tests()
