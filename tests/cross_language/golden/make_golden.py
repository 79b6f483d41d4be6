#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes one message of each type that goes on a channel by itself: TYPE.bin as on the wire, TYPE.json its values. --check: only
tells whether they are what lcmtypes/ says now (exit 1: no).

The values are arbitrary but use what languages may differ in: negative numbers, all 53 bits that every language has, text
that is not ASCII, bytes above 127, numbers without a short decimal form. No array is empty."""
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "integration"))
from lcm_types import PRIMITIVES, load_types  # noqa: E402
from types import SimpleNamespace  # noqa: E402

TYPES = load_types()
PARTS = {kind for one in TYPES.values() for kind, _, _ in one.members}
TOP = sorted(name for name in TYPES if name not in PARTS)
LENGTH = 3


class Values:
    """Another value each time."""

    def __init__(self):
        self.count = 0

    def one(self, kind):
        self.count += 1
        n = self.count
        if kind in TYPES:
            return self.message(TYPES[kind])
        if kind == "string":
            return f"Käfig {n} \"≤\\"
        if kind in ("double", "float"):
            return (-1) ** n * n / 7
        if kind == "byte":
            return 77 * n % 256
        bits = {"b": 7, "h": 15, "i": 31, "q": 53}[PRIMITIVES[kind]]
        return (-1) ** n * (2**bits - 1 - n)

    def message(self, one):
        """Values of all members by their names; counts fit."""
        counts = {d for _, _, dimensions in one.members for d in dimensions if not d.isdigit()}
        values = {}
        for kind, name, dimensions in one.members:
            if name in counts:
                values[name] = LENGTH
            elif dimensions:
                length = int(dimensions[0]) if dimensions[0].isdigit() else LENGTH
                values[name] = [self.one(kind) for _ in range(length)]
            else:
                values[name] = self.one(kind)
        return values


def spaces(value):
    if isinstance(value, dict):
        return SimpleNamespace(**{k: spaces(v) for k, v in value.items()})
    return [spaces(v) for v in value] if isinstance(value, list) else value


def files():
    """Name -> bytes."""
    made = {}
    for name in TOP:
        values = Values().message(TYPES[name])
        made[f"{name}.bin"] = TYPES[name].encode(**vars(spaces(values)))
        made[f"{name}.json"] = (json.dumps(values, indent=1, ensure_ascii=False) + "\n").encode()
    return made


def main():
    made = files()
    found = {p.name: p.read_bytes() for p in HERE.glob("*_t.*")}
    if sys.argv[1:] == ["--check"]:
        stale = sorted(n for n in made.keys() | found.keys() if made.get(n) != found.get(n))
        if stale:
            sys.exit(f"not what lcmtypes/ says, run tests/cross_language/golden/make_golden.py: {', '.join(stale)}")
        return
    for name in found.keys() - made.keys():
        (HERE / name).unlink()
    for name, data in made.items():
        (HERE / name).write_bytes(data)


if __name__ == "__main__":
    main()
