# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""graspd-spy: lcm-spy's own search for types finds all of ours in the jar, by the fingerprints that are on the wire."""
import os
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/integration"))
from lcm_types import load_types  # noqa: E402  pylint: disable=wrong-import-position

SPY = pathlib.Path(os.environ.get("GRASPD_BUILD", ROOT / "build")) / "bin/graspd-spy"


def spy(*arguments, **environment):
    return subprocess.run([SPY, *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          check=False, env={**os.environ, **environment})


class Spy(unittest.TestCase):
    def test_finds_every_type(self):
        result = spy("--check")
        self.assertEqual(result.returncode, 0, result.stderr)
        found = {name: int(number, 16) for number, name in re.findall(r"(?m)^([0-9a-f]{16}) (\w+) found$", result.stdout)}
        self.assertEqual(found, {name: int.from_bytes(kind.fingerprint, "big") for name, kind in load_types().items()})

    def test_wrong_usage(self):
        for arguments in (["--what"], ["--lcm-url"], ["file"]):
            result = spy(*arguments)
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertIn("graspd-spy: ", result.stderr)

    def test_says_what_is_missing(self):
        result = spy("--check", PATH="/nonexistent")
        self.assertNotEqual(result.returncode, 0)
        self.assertNotEqual(result.stderr, "")


if __name__ == "__main__":
    if not SPY.exists():
        print("SKIPPED: graspd-spy was not built: it needs a JDK and Debian's liblcm-java")
        sys.exit(77)
    unittest.main(verbosity=2)
