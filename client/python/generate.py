#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the package's types from ../../lcmtypes with lcm-gen; --check: only tells whether they are up to date (exit 1: no).

They are part of the repository so that pip needs no lcm-gen."""
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
LICENCE = "# SPDX-FileCopyrightText: 2026 The graspd authors\n# SPDX-License-Identifier: BSD-3-Clause\n"


def generated(folder):
    """Name of a file -> its text."""
    types = sorted(map(str, (HERE.parents[1] / "lcmtypes").glob("*.lcm")))
    subprocess.run(["lcm-gen", "--python", "--ppath", folder, *types], check=True)
    return {path.name: LICENCE + path.read_text(encoding="utf-8")
            for path in sorted(pathlib.Path(folder, "graspd").glob("*_t.py"))}


def main():
    package = HERE / "graspd"
    with tempfile.TemporaryDirectory() as folder:
        wanted = generated(folder)
    found = {path.name: path.read_text(encoding="utf-8") for path in package.glob("*_t.py")}
    names = (package / "__init__.py").read_text(encoding="utf-8")
    missing = sorted(name for name in wanted if f"from .{name[:-3]} import {name[:-3]}\n" not in names)
    if missing:
        sys.exit(f"client/python/graspd/__init__.py does not import {', '.join(missing)}")
    if sys.argv[1:] == ["--check"]:
        stale = sorted(name for name in wanted.keys() | found.keys() if wanted.get(name) != found.get(name))
        if stale:
            sys.exit(f"not what lcm-gen makes of lcmtypes/, run client/python/generate.py: {', '.join(stale)}")
        return
    for name in found.keys() - wanted.keys():
        (package / name).unlink()
    for name, text in wanted.items():
        (package / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
