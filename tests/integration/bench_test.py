# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""graspd-bench measures what it says, in the shape that it says, on tiny inputs; how long anything takes is not judged."""
import json
import os
import xml.etree.ElementTree

from harness import GraspdTest, run_tests

SPREAD = ["min", "q1", "median", "q3", "p99", "max"]
TINY = ["--width", "160", "--scene", "easy", "--scenes", "1", "--leaf", "0.008", "--points", "1000,2000", "--rounds", "2",
        "--pcl-rounds", "1", "--threads", "1,2", "--rate", "5", "--seconds", "2"]


class Bench(GraspdTest):
    def measure(self, *arguments, code=0):
        file = self.folder / "bench.json"
        program = self.run_program("graspd-bench", *arguments, "--json", file, code=code)
        return program, json.loads(file.read_text(encoding="utf-8"))

    def check_spread(self, result):
        for name, times in result["times_ms"].items():
            values = [times[key] for key in SPREAD]
            self.assertEqual(values, sorted(values), name)
            self.assertGreater(times["rounds"], 0, name)
            self.assertGreaterEqual(times["min"], 0, name)

    def test_every_suite(self):
        plot = self.folder / "plot.svg"
        program, report = self.measure("--suite", "all", "--paper", "--plot", plot, *TINY)
        self.assertEqual(report["skipped"], [])
        results = {}
        for result in report["results"]:
            self.check_spread(result)
            self.assertIn(f"{result['suite']}: {result['name']}", program.out)
            results.setdefault(result["suite"], []).append(result)
        counts = {suite: len(found) for suite, found in results.items()}
        self.assertEqual(counts, {"stages": 2, "points": 4, "organized": 8, "codec": 4, "lcm": 1})
        for suite in ("stages", "points", "organized"):
            for result in results[suite]:
                times = result["times_ms"]
                rounds = {name: times[name]["rounds"] for name in ("whole", "surfaces", "plain", "pcl") if name in times}
                # PCL sees the same image whether it is thinned by voxels or by blocks of pixels.
                peer = {} if result["name"].endswith(", blocks") else {"pcl": 1}
                self.assertEqual(rounds, {"whole": 2, "surfaces": 2, "plain": 2} | peer)
                stages = sum(times[name]["min"] for name in times if name.startswith("stage "))
                self.assertLessEqual(stages, times["whole"]["max"] + 1e-6)
        for result, wanted in zip(results["points"], [1000, 1000, 2000, 2000]):
            self.assertAlmostEqual(result["points_in"] / wanted, 1, delta=0.1)
        self.assertEqual([r["points_in"] for r in results["organized"]], [160 * 120] * 4 + [80 * 60] * 4)
        self.assertEqual([r["name"] for r in results["organized"][:2]], ["160 x 120", "160 x 120, blocks"])
        self.check_codec(results["codec"])
        self.check_lcm(results["lcm"][0])
        self.assertEqual(xml.etree.ElementTree.parse(plot).getroot().tag, "{http://www.w3.org/2000/svg}svg")

    def check_codec(self, results):
        self.assertEqual([r["name"] for r in results], ["point_cloud_t"] * 2 + ["depth_image_t"] * 2)
        for result in results:
            self.assertEqual(set(result["times_ms"]) & {"whole", "decode", "detect", "encode"},
                             {"whole", "decode", "detect", "encode"})
            self.assertGreater(result["figures"]["answer_bytes"], 0)

    def check_lcm(self, result):
        figures = result["figures"]
        self.assertEqual(figures["sent"], 10)
        self.assertEqual(figures["answers"] + figures["lost"], figures["sent"])
        self.assertEqual(figures["lost"], 0)
        self.assertEqual(result["times_ms"]["whole"]["rounds"], figures["answers"] - figures["dropped"])
        self.assertGreater(figures["daemon_peak_bytes"], 1e6)
        self.assertEqual([figures["hogs"], figures["hog_cores"]], [0, 0])

    def test_beside_a_hog(self):
        program, report = self.measure("--suite", "lcm", "--hog", "1", *TINY[:6], *TINY[-4:])
        result = report["results"][0]
        self.assertEqual(result["name"], "5 Hz, 1 hog")
        self.assertIn("hog_cores", program.out)
        self.assertEqual(result["figures"]["hogs"], 1)
        self.assertGreater(result["figures"]["hog_cores"], 0)
        self.assertLess(result["figures"]["hog_cores"], 1.1)
        self.assertEqual(result["figures"]["sent"], 10)

    def test_more_hogs_than_cores(self):
        hogs = os.cpu_count() + 1
        program, _ = self.measure("--suite", "lcm", "--hog", str(hogs), *TINY[:6], code=1)
        self.assertIn("fewer cores than hogs", program.err)

    def test_files(self):
        frames = self.simulate(1, "--scene", "easy", width=160)
        _, report = self.measure("--suite", "stages", "--threads", "1", "--rounds", "1", "--no-pcl", frames)
        self.assertEqual(len(report["results"]), 1)
        self.assertNotIn("pcl", report["results"][0]["times_ms"])

    def test_without_multicast_it_says_so(self):
        os.system("ip route del 239.0.0.0/8 dev lo")
        self.addCleanup(os.system, "ip route add 239.0.0.0/8 dev lo")
        program, report = self.measure("--suite", "lcm", *TINY[:6], code=1)
        self.assertIn("lcm: not measured: ", program.err)
        self.assertEqual([skipped["suite"] for skipped in report["skipped"]], ["lcm"])

    def test_a_daemon_that_does_not_come_up(self):
        config = self.write_config("nonsense: 1\n")
        program, _ = self.measure("--suite", "lcm", "--config", config, *TINY[:6], code=1)
        self.assertIn("nonsense", program.err)

    def test_what_does_not_go_together(self):
        for arguments in (["--suite", "codec", "--plot", "x.svg"], ["--suite", "nothing"], ["--suite", "lcm", "x.pcd"],
                          ["--rounds", "0"], ["--rate", "0"], ["--hog", "-1"], ["--suite", "codec", "--hog", "1"], ["--points", "3"], ["--graspd", "/no/such/program"]):
            self.assertNotEqual(self.run_program("graspd-bench", *arguments, code=2).err, "")


if __name__ == "__main__":
    run_tests()
