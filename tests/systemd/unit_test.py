# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""config/systemd/graspd.service: systemd finds nothing wrong in it, and nearly nothing that it exposes."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
UNIT = ROOT / "config/systemd/graspd.service"
GRASPD = pathlib.Path(os.environ.get("GRASPD_BIN", ROOT / "build/bin")) / "graspd"
MOST_EXPOSURE = 1.2


def analyze(*arguments):
    return subprocess.run(["systemd-analyze", *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, check=False)


class Unit(unittest.TestCase):
    def test_nothing_is_wrong(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / UNIT.name
            copy.write_text(UNIT.read_text(encoding="utf-8").replace("ExecStart=/usr/bin/graspd", f"ExecStart={GRASPD}"),
                            encoding="utf-8")
            result = analyze("verify", "--man=no", copy)
        self.assertEqual((result.returncode, result.stdout), (0, ""))

    def test_exposure(self):
        result = analyze("security", "--offline=true", f"--threshold={MOST_EXPOSURE * 10:.0f}", UNIT)
        self.assertEqual(result.returncode, 0, result.stdout)
        exposure = re.search(r"Overall exposure level for graspd.service: ([\d.]+)", result.stdout)
        self.assertLessEqual(float(exposure.group(1)), MOST_EXPOSURE)

    def test_what_is_promised(self):
        text = UNIT.read_text(encoding="utf-8")
        for line in ("Type=notify", "DynamicUser=yes", "CapabilityBoundingSet=", "IPAddressDeny=any", "Restart=on-failure",
                     "IPAddressAllow=localhost", "SystemCallFilter=@system-service", "ExecReload=/bin/sh -c 'kill -HUP $MAINPID'"):
            self.assertIn(line + "\n", text)
        for key in ("WatchdogSec", "MemoryMax", "IPAddressAllow=239."):
            self.assertRegex(text, rf"(?m)^{key}")


if __name__ == "__main__":
    if shutil.which("systemd-analyze") is None:
        print("SKIPPED: systemd-analyze is missing")
        sys.exit(77)
    unittest.main(verbosity=2)
