#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes graspd/types.go from ../../lcmtypes; --check: only tells whether it is up to date (exit 1: no).

lcm-gen of LCM 1.3 does not know Go, and that of 1.5 ends with a segmentation fault at arrays of variable size."""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tests/integration"))
from lcm_types import load_types  # noqa: E402

TARGET = HERE / "graspd/types.go"
GO = {"int8_t": "int8", "int16_t": "int16", "int32_t": "int32", "int64_t": "int64", "double": "float64", "byte": "uint8",
      "string": "string"}
HEAD = """// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause

// Made by generate.py from lcmtypes/, where every member's meaning and unit is.

package graspd
"""


def camel(name):
    return "".join(part.capitalize() for part in name.removesuffix("_t").split("_"))


def member(kind, name, dimensions):
    go, tag = GO.get(kind) or camel(kind), f'json:"{name}"'
    if dimensions and dimensions[0].isdigit():
        go = f"[{dimensions[0]}]{go}"
    elif dimensions:
        go, tag = f"[]{go}", f'{tag} count:"{camel(dimensions[0])}"'
    return camel(name), go, f"`{tag}`"


def aligned(rows):
    """As gofmt has it."""
    widths = [max(map(len, column)) for column in zip(*rows)]
    return ["\t" + " ".join(text.ljust(width) for text, width in zip(row, widths)).rstrip() for row in rows]


def go_type(one):
    name = camel(one.name)
    lines = [f"// {name} is {one.name}.", f"type {name} struct {{", *aligned([member(*m) for m in one.members]), "}", ""]
    if one.constants:
        lines += ["// Values of members.", "const ("]
        rows = [(name + camel(key.lower()), f"= {value}") for key, value in one.constants.items()]
        lines += [*aligned(rows), ")", ""]
    return "\n".join(lines + [f"func (*{name}) fingerprint() uint64 {{ return 0x{one.fingerprint.hex()} }}", ""])


def main():
    types = load_types(HERE.parents[1] / "lcmtypes")
    text = HEAD + "".join("\n" + go_type(types[name]) for name in sorted(types))
    if sys.argv[1:] != ["--check"]:
        TARGET.write_text(text, encoding="utf-8")
    elif not TARGET.exists() or TARGET.read_text(encoding="utf-8") != text:
        sys.exit("client/go/graspd/types.go is not what lcmtypes/ says, run client/go/generate.py")


if __name__ == "__main__":
    main()
