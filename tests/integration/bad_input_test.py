# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Input that cannot be used: one clear line that names it, the right exit code, no crash."""
import pathlib
import subprocess

from harness import BIN, GraspdTest, run_tests

GRIPPER = pathlib.Path(__file__).resolve().parents[2] / "config/grippers/paper_80mm.yaml"


class BadInput(GraspdTest):
    def assert_one_line(self, program, *words):
        lines = [line for line in program.err.splitlines() if line.strip()]
        self.assertEqual(len(lines), 1, program.err)
        for word in words:
            self.assertIn(str(word), lines[0])

    def assert_config_refused(self, text, *words):
        config = self.write_config(text)
        for arguments in (["--config", config], ["--check-config", "--config", config]):
            self.assert_one_line(self.run_program("graspd", *arguments, code=2), config, *words)

    def test_configuration_files(self):
        missing = self.folder / "missing.yaml"
        self.assert_one_line(self.run_program("graspd", "--config", missing, code=2), missing)
        self.assert_config_refused("workers: 2\nworker: 3\n", "worker")
        self.assert_config_refused("detect: {workspace: {max_rnage_m: 3}}\n", "detect.workspace.max_rnage_m")
        self.assert_config_refused("sources:\n  - name: camera\n", "sources[0]", "channel")
        self.assert_config_refused("workers: many\n", "workers", "many")
        self.assert_config_refused("workers: -1\n", "workers", "-1")
        self.assert_config_refused("workers: 2\nworkers: 3\n", "workers")
        self.assert_config_refused("workers: [2\n")
        self.assert_config_refused("- workers\n")
        self.assert_config_refused("sources: [{name: a, channel: '[', gripper: paper_80mm}]\n", "channel")

    def test_impossible_grippers(self):
        keys = dict(aperture_m=0.08, finger_width_m=0.01, finger_thickness_m=0.02, finger_length_m=0.06,
                    grasp_depth_m=0.03, min_gap_m=0.012)
        for key, value in (("aperture_m", 0), ("aperture_m", -0.08), ("min_gap_m", 0.009), ("grasp_depth_m", 0.07),
                           ("aperture_m", ".nan")):
            with self.subTest(key=key, value=value):
                gripper = ", ".join(f"{k}: {v}" for k, v in {**keys, key: value}.items())
                self.assert_config_refused(f"sources: [{{name: a, channel: A, gripper: {{name: x, {gripper}}}}}]\n",
                                           "sources[0].gripper")
        self.assert_config_refused("sources: [{name: a, channel: A, gripper: no_such_gripper}]\n", "no_such_gripper")

    def test_printed_configuration_is_accepted(self):
        printed = self.run_program("graspd", "--print-config").out
        config = self.write_config(printed)
        self.run_program("graspd", "--check-config", "--config", config)
        self.assertEqual(self.run_program("graspd", "--print-config", "--config", config).out, printed)

    def test_files_that_are_no_clouds(self):
        text, empty = self.folder / "text.pcd", self.folder / "empty.pcd"
        text.write_text("this is no point cloud\n", encoding="ascii")
        empty.touch()
        cut = self.folder / "cut.pcd"
        whole = next(self.simulate(1).glob("*.pcd")).read_bytes()
        cut.write_bytes(whole[:len(whole) // 2])
        folder = self.folder / "nothing"
        folder.mkdir()
        for path in (self.folder / "missing.pcd", text, empty, cut, folder, self.folder / "cloud.xyz"):
            for name in ("graspd-detect", "graspd-publish"):
                with self.subTest(program=name, path=path.name):
                    self.assert_one_line(self.run_program(name, path, code=1), path)

    def test_no_multicast_route(self):
        subprocess.run(["ip", "route", "del", "239.0.0.0/8", "dev", "lo"], check=True)
        self.addCleanup(subprocess.run, ["ip", "route", "add", "239.0.0.0/8", "dev", "lo"], check=True)
        impatient = self.write_config("lcm: {give_up_s: 0.3, retry_longest_s: 0.1}")
        for name, *options in (["graspd", "--config", impatient], ["graspd-listen"], ["graspd-status"],
                               ["graspd-simulate"]):
            with self.subTest(program=name):
                program = self.run_program(name, *options, code=1)
                self.assertIn("ip route add 239.0.0.0/8 dev lo", program.err)
                self.assertIn("239.255.76.67:7667", program.err)

    def test_lcm_urls(self):
        for url in ("nonsense", "udpm://not.an.address:7667", "udpm://239.255.76.67:99999", "nosuch://"):
            for name in ("graspd", "graspd-listen"):
                with self.subTest(program=name, url=url):
                    self.assertIn(url, self.run_program(name, "--lcm-url", url, code=1).err)

    def test_standard_output_that_is_closed(self):
        """`graspd-detect ... | head -1` ends quietly."""
        frames = self.simulate(1)
        command = f"'{BIN}/graspd-detect' '{frames}' '{frames}' '{frames}' | head -1"
        shell = subprocess.run(["sh", "-c", command], capture_output=True, text=True, check=False)
        self.assertIn("frame", shell.stdout)
        self.assertEqual(shell.stderr, "")


if __name__ == "__main__":
    run_tests()
