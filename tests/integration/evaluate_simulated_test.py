# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Handles of simulated scenes that went through the daemon are graded like those of the method itself."""
import csv
import io
import json
import signal

from harness import HANDLES, SANITIZED, GraspdTest, run_tests, wait_until
from playback import CONFIG, PROBE, empty_list

COUNT = 2 if SANITIZED else 5
SEED = 5
SCENE = "medium"


class EvaluateSimulated(GraspdTest):
    def evaluate(self, *arguments):
        program = self.run_program("graspd-evaluate", "--simulate", SCENE, "--seed", SEED, "--scenes", COUNT,
                                   "--format", "json", "--explain", *arguments)
        return json.loads(program.out)

    def record(self):
        """What the daemon answers to the simulated frames, as a CSV file."""
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(CONFIG))
        listener = self.start_listening("graspd-listen", "--format", "csv", "--empty-rows", "--channel", HANDLES)
        self.probe(bus, HANDLES, empty_list(PROBE), lambda: PROBE in listener.out, "the listener's first line")
        self.run_program("graspd-simulate", "--scene", SCENE, "--new-scene-every", 1, "--seed", SEED, "--frames", COUNT,
                         "--rate", 5)

        def rows():
            table = csv.DictReader(io.StringIO("\n".join(listener.lines())))
            return [row for row in table if row["frame"] != PROBE]
        wait_until(lambda: len({row["seq"] for row in rows()}) == COUNT, "the last frame's handles")
        self.assertEqual(listener.stop(signal.SIGINT)[0], 0, listener.err)
        path = self.folder / "handles.csv"
        with open(path, "w", encoding="utf-8", newline="") as out:
            writer = csv.DictWriter(out, rows()[0].keys())
            writer.writeheader()
            writer.writerows(rows())
        return path

    def test_through_the_daemon(self):
        direct = self.evaluate()
        daemon = self.evaluate("--handles", self.record())
        self.assertNotIn("unnamed", daemon)
        for table in (direct, daemon):
            del table["figures"][0]["run"]
        for name in ("figures", "failures", "kinds", "worst"):
            self.assertEqual(daemon[name], direct[name], name)
        for name in ("failed", "missed"):
            self.assertEqual([(row["frame"], row["object"]) for row in daemon[name]],
                             [(row["frame"], row["object"]) for row in direct[name]], name)

    def test_tables_agree(self):
        tables = self.evaluate()
        figures = tables["figures"][0]
        self.assertEqual(figures["frames"], COUNT)
        self.assertGreater(figures["objects"], COUNT)
        self.assertGreater(figures["valid"], 0)
        self.assertEqual(len(tables["failed"]), figures["handles"] - figures["valid"])
        self.assertEqual(len(tables["missed"]), figures["objects"] - figures["found"])
        self.assertEqual(sum(row["graspable"] for row in tables["kinds"]), figures["objects"])

    def test_stability(self):
        tables = self.evaluate("--stability", 3)
        self.assertEqual(list(tables), ["stability"])
        self.assertEqual(tables["stability"][-1]["object"], "all")

    def test_refuses_what_does_not_go_together(self):
        for arguments in (["frames.pcd"], ["--graspable", "list.csv"]):
            program = self.run_program("graspd-evaluate", "--simulate", SCENE, *arguments, code=2)
            self.assertIn("excludes", program.err)
        self.assertIn("--simulate", self.run_program("graspd-evaluate", "--scenes", 3, code=2).err)


if __name__ == "__main__":
    run_tests()
