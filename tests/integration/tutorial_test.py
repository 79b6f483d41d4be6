# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""The tutorial's programs with its configuration, the daemon and a simulated camera: they plan the same, and it takes an object.
Python needs numpy and LCM's package: that of tests/cross_language/run where it has been built."""
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import unittest

from harness import BIN, PATIENCE_S, GraspdTest, run_tests

ROOT = pathlib.Path(__file__).resolve().parents[2]
TUTORIAL = ROOT / "client/tutorial"
CELL = TUTORIAL / "cell.yaml"
PICK = BIN.parent / "client/tutorial/pick"
LANGUAGES = pathlib.Path(os.environ.get("GRASPD_LANGUAGES", BIN.parent / "languages"))
ON_OBJECT_M = 0.02


def python_with_numpy():
    for python in (LANGUAGES / "python/bin/python", sys.executable):
        environment = {**os.environ, "PYTHONPATH": str(ROOT / "client/python")}
        try:
            if subprocess.run([str(python), "-c", "import graspd"], env=environment, stderr=subprocess.DEVNULL,
                              check=False).returncode == 0:
                return str(python)
        except FileNotFoundError:
            continue
    return None


def moved(T, p):
    return [sum(T[row][k] * p[k] for k in range(3)) + T[row][3] for row in range(3)]


def camera_pose():
    """T of the base frame and the camera's, from cell.yaml."""
    text = CELL.read_text(encoding="utf-8")
    numbers = {key: [float(n) for n in re.search(key + r": \[([^\]]*)\]", text).group(1).split(",")]
               for key in ("position_m", "rpy_rad")}
    roll, pitch, yaw = numbers["rpy_rad"]
    cr, sr, cp, sp, cy, sy = (f(a) for a in (roll, pitch, yaw) for f in (math.cos, math.sin))
    x, y, z = numbers["position_m"]
    return [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr, x],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr, y], [-sp, cp * sr, cp * cr, z]]


class Tutorial(GraspdTest):
    def setUp(self):
        super().setUp()
        self.bus = self.open_bus()
        self.start_daemon(self.bus, self.write_config(CELL.read_text(encoding="utf-8")))
        self.truth = self.folder / "truth.jsonl"

    def plan(self, *command):
        """What the program prints while the camera runs."""
        program = subprocess.Popen(command, stdout=subprocess.PIPE, text=True,
                                   env={**os.environ, "PYTHONPATH": str(ROOT / "client/python")})
        self.addCleanup(program.stdout.close)
        self.addCleanup(program.wait)
        self.addCleanup(program.kill)
        camera = self.start("graspd-simulate", "--width", 320, "--rate", 5, "--sensor", "ideal", "--truth", self.truth)
        out, _ = program.communicate(timeout=PATIENCE_S)
        camera.stop()
        self.assertEqual(program.returncode, 0)
        return json.loads(out)

    def assert_takes_an_object(self, plan):
        self.assertEqual(plan["frame"], "base")
        self.assertLessEqual(plan["object_m"], plan["opening_m"])
        self.assertLessEqual(plan["opening_m"], 0.080)
        before, grasp, lifted = plan["pre_grasp"], plan["grasp"], plan["lifted"]
        for row in range(3):
            self.assertAlmostEqual(grasp[row][3] - before[row][3], 0.1 * grasp[row][2], places=6)
            self.assertAlmostEqual(lifted[row][3] - grasp[row][3], 0.1 if row == 2 else 0, places=6)
        self.assertGreater(grasp[2][3], -0.005, "a fingertip is in the table")
        self.assertLess(grasp[2][2], 0.3, "the hand comes from below")
        for pose in (before, grasp, lifted):
            columns = list(zip(*pose))[:3]
            for i, a in enumerate(columns):
                for k, b in enumerate(columns):
                    self.assertAlmostEqual(sum(x * y for x, y in zip(a[:3], b[:3])), float(i == k), places=5)
        self.assertGreaterEqual(grasp[0][0], 0, "the wrist turns more than it has to")
        self.assertLess(self.distance_to_objects(grasp), ON_OBJECT_M)

    def distance_to_objects(self, grasp):
        """From the middle between the fingers, a grasp depth or less before the fingertips, to what the camera saw of objects."""
        T = camera_pose()
        line = json.loads(self.truth.read_text(encoding="utf-8").splitlines()[0])
        points = [moved(T, p) for item in line["objects"] for p in item["points"]]
        self.assertGreater(len(points), 100)
        self.assertLess(abs(min(p[2] for p in points)), 0.02, "the configuration's pose is not the camera's")
        middle = [moved(grasp, (0, 0, -depth)) for depth in (0.0, 0.01, 0.02, 0.03)]
        return min(math.dist(m, p) for m in middle for p in points)

    def test_cpp(self):
        self.assert_takes_an_object(self.plan(str(PICK)))

    def test_python_plans_the_same(self):
        python = python_with_numpy()
        if python is None:
            raise unittest.SkipTest("no Python with numpy and lcm here: tests/cross_language/run makes one")
        plan = self.plan(python, str(TUTORIAL / "pick.py"))
        self.assert_takes_an_object(plan)
        other = self.plan(str(PICK))
        for pose in ("pre_grasp", "grasp", "lifted"):
            for a, b in zip(plan[pose], other[pose]):
                for x, y in zip(a, b):
                    self.assertAlmostEqual(x, y, places=6)  # the scene stands still, and an ideal camera has no noise

    def test_the_text_shows_the_programs_as_they_are(self):
        text = (TUTORIAL / "README.md").read_text(encoding="utf-8")
        blocks = re.findall(r"```(python|cpp|yaml)\n(.*?)```", text, re.DOTALL)
        self.assertEqual({kind for kind, _ in blocks}, {"python", "cpp", "yaml"})
        files = {"python": "pick.py", "cpp": "pick.cpp", "yaml": "cell.yaml"}
        for kind, block in blocks:
            self.assertIn(block, (TUTORIAL / files[kind]).read_text(encoding="utf-8"), f"not in {files[kind]}")


if __name__ == "__main__":
    run_tests()
