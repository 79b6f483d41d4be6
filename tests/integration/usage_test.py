# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every program explains itself, tells its version and refuses what it does not know."""
import csv
import json
import re
import struct

from harness import GraspdTest, run_tests

PROGRAMS = ["graspd", "graspd-detect", "graspd-publish", "graspd-simulate", "graspd-listen", "graspd-log",
            "graspd-status", "graspd-view", "graspd-bridge", "graspd-meldis", "graspd-evaluate", "graspd-bench", "graspd-draw"]
WITHOUT_LCM = ["graspd-detect", "graspd-evaluate", "graspd-bench", "graspd-draw"]


# What comes before an option that is wrong, where something has to.
REQUIRED = {"graspd-detect": ["cloud.pcd"], "graspd-evaluate": ["cloud.pcd"], "graspd-publish": ["cloud.pcd"],
            "graspd-log": ["a.log"], "graspd-draw": ["cloud.pcd", "-o", "a.png"]}


class Usage(GraspdTest):
    def test_help(self):
        for name in PROGRAMS:
            program = self.run_program(name, "--help")
            self.assertRegex(program.out, r"(?i)\busage\b")
            for option in ("--help", "--version"):
                self.assertIn(option, program.out)
            self.assertEqual(program.err, "")

    def test_every_program_on_the_bus_takes_a_url(self):
        for name in PROGRAMS:
            if name not in WITHOUT_LCM:
                self.assertRegex(self.run_program(name, "--help").out, r"-l,\s*--lcm-url")

    def test_version(self):
        versions = set()
        for name in PROGRAMS:
            program = self.run_program(name, "--version")
            self.assertRegex(program.out, r"\d+\.\d+\.\d+")
            versions.update(re.findall(r"\d+\.\d+\.\d+", program.out))
        self.assertEqual(len(versions), 1, versions)

    def test_unknown_option(self):
        for name in PROGRAMS:
            program = self.run_program(name, *REQUIRED.get(name, []), "--no-such-option", code=2)
            self.assertEqual(program.out, "")
            self.assertIn("--no-such-option", program.err)

    def test_nothing_where_something_is_required(self):
        for name in REQUIRED:
            self.assertNotEqual(self.run_program(name, code=2).err, "")

    def test_detect_explains_every_segment(self):
        frames = self.simulate(2)
        lists = [json.loads(line) for line in
                 self.run_program("graspd-detect", "--explain", "-f", "json", frames).out.splitlines()]
        self.assertEqual(len(lists), 2)
        for answer in lists:
            self.assertEqual(len(answer["segments"]), answer["num_segments"])
        rows = list(csv.DictReader(self.run_program("graspd-detect", "--explain", "-f", "csv", frames).lines()))
        segments = [segment for answer in lists for segment in answer["segments"]]
        self.assertGreater(len(rows), 0)
        self.assertEqual([(row["reason"], int(row["candidates"]), int(row["listed"])) for row in rows],
                         [(s["reason"], s["num_candidates"], s["num_listed"]) for s in segments])
        text = self.run_program("graspd-detect", "--explain", frames).out
        self.assertEqual(text.count("segments without a handle: "), 2)
        plain = self.run_program("graspd-detect", "-f", "csv", frames).lines()
        self.assertEqual(len(plain) - 1, sum(int(row["listed"]) for row in rows))

    def test_draw_makes_the_same_picture_again(self):
        frames = self.simulate(1)
        pictures = {}
        for name, options in {"a": [], "again": ["--threads", 1], "top": ["--view", "top"], "depth": ["--color", "depth"],
                              "small": ["--size", "320x240"], "robotiq": ["--gripper", "robotiq_2f_140"]}.items():
            self.run_program("graspd-draw", frames, "-o", self.folder / f"{name}.png", *options)
            pictures[name] = (self.folder / f"{name}.png").read_bytes()
            self.assertEqual(pictures[name][:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(pictures["a"], pictures.pop("again"))
        self.assertEqual(len(set(pictures.values())), 5)
        self.assertEqual(struct.unpack(">II", pictures["small"][16:24]), (320, 240))
        for wrong in (["--size", "10x10"], ["--size", "960"], ["--view", "left"], ["--color", "pink"]):
            self.run_program("graspd-draw", frames, "-o", "no.png", *wrong, code=2)
        for missing in (["--frame", 1, frames], [self.folder / "none.log"]):
            program = self.run_program("graspd-draw", *missing, "-o", self.folder / "no.png", code=1)
            self.assertEqual(len(program.err.splitlines()), 1)
        self.assertFalse((self.folder / "no.png").exists())

    def test_the_explanation_has_no_empty_rows(self):
        program = self.run_program("graspd-detect", "--explain", "--empty-rows", "cloud.pcd", code=2)
        self.assertIn("--explain", program.err)

    def test_option_without_its_value(self):
        for name in PROGRAMS:
            if name not in WITHOUT_LCM:
                program = self.run_program(name, "--lcm-url", code=2)
                self.assertIn("--lcm-url", program.err)


if __name__ == "__main__":
    run_tests()
