#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""The installed library: the project in example/ builds against it alone, and finds in a simulated cloud what graspd-detect finds.

    tests/packaging/library_test.py      needs a build folder; GRASPD_BUILD names another than build/
"""
import csv
import os
import pathlib
import subprocess
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
BUILD = pathlib.Path(os.environ.get("GRASPD_BUILD", HERE.parents[1] / "build"))


def run(*command):
    result = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if result.returncode != 0:
        raise AssertionError(f"{command}: {result.returncode}\n{result.stdout[-3000:]}\n{result.stderr[-3000:]}")
    return result.stdout


def rotation(quaternion):
    w, x, y, z = quaternion
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


class Library(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="graspd-library-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.installed = cls.folder / "installed"
        run("cmake", "--install", BUILD, "--prefix", cls.installed, "--component", "dev")
        run("cmake", "-S", HERE / "example", "-B", cls.folder / "build", f"-DCMAKE_PREFIX_PATH={cls.installed}",
            "-DCMAKE_BUILD_TYPE=Release")
        run("cmake", "--build", cls.folder / "build")
        run(BUILD / "bin/graspd-simulate", "--output", cls.folder / "clouds", "--frames", 1, "--seed", 3)
        cls.cloud = next((cls.folder / "clouds").glob("*.pcd"))

    def test_headers_share_one_folder(self):
        headers = list((self.installed / "include").rglob("*.hpp"))
        self.assertGreater(len(headers), 10)
        for header in headers:
            self.assertEqual(header.parent, self.installed / "include/graspd/pipeline")
            self.assertNotIn('"service/', header.read_text(encoding="utf-8"))

    def test_every_header_compiles(self):
        cache = run("cmake", "-L", "-N", self.folder / "build")
        eigen = next(line.split("=", 1)[1] for line in cache.splitlines() if line.startswith("Eigen3_DIR:"))
        headers = sorted((self.installed / "include/graspd/pipeline").glob("*.hpp"))
        source = self.folder / "all.cpp"
        source.write_text("".join(f"#include <graspd/pipeline/{header.name}>\n" for header in headers), encoding="utf-8")
        run("c++", "-std=c++20", "-fsyntax-only", "-I", self.installed / "include",
            "-isystem", pathlib.Path(eigen).parents[2] / "include/eigen3", source)

    def test_no_path_of_the_build_machine_is_left(self):
        for file in (self.installed / "lib").rglob("*.cmake"):
            text = file.read_text(encoding="utf-8")
            self.assertNotIn(str(HERE.parents[1]), text, file)

    def test_another_minor_version_is_refused(self):
        project = self.folder / "future"
        project.mkdir()
        (project / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.22)\nproject(future C CXX)\n"
                                                "find_package(graspd 0.999 REQUIRED)\n", encoding="utf-8")
        with self.assertRaisesRegex(AssertionError, "0.999"):
            run("cmake", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={self.installed}")

    def test_finds_what_graspd_detect_finds(self):
        lines = run(self.folder / "build/pick_from_pcd", self.cloud).splitlines()
        rows = list(csv.DictReader(run(BUILD / "bin/graspd-detect", "--format", "csv", self.cloud).splitlines()))
        self.assertGreater(len(rows), 0)
        self.assertEqual(len(lines), len(rows))
        for line, row in zip(lines, rows):
            numbers = list(map(float, line.split()))
            self.assertEqual([numbers[3], numbers[7], numbers[11]], [float(row[c]) for c in ("px", "py", "pz")])
            self.assertEqual(numbers[16], float(row["score"]))
            expected = rotation([float(row[c]) for c in ("qw", "qx", "qy", "qz")])
            for i in range(3):
                for j in range(3):
                    self.assertAlmostEqual(numbers[4 * i + j], expected[i][j], delta=1e-5)


if __name__ == "__main__":
    unittest.main(verbosity=2)
