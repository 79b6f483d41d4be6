# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Finds the functions of a C++ file by its braces: enough to measure their length without a compiler."""
import re

# Comments, raw strings, strings and characters; digit separators (1'000) are no characters.
NOISE = re.compile(
    r"""//[^\n]*|/\*.*?\*/|R"(?P<d>[^()\s\\]{0,16})\(.*?\)(?P=d)"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'""",
    re.DOTALL)
SCOPE = re.compile(r"\b(namespace|class|struct|union|enum)\b|\bextern\s*$")


def _blank(match):
    """As many lines as before, and nothing else."""
    return "\n" * match.group().count("\n") or " "


def long_blocks(text, limit):
    """(line, number of lines) of every outermost block of more than limit lines that is no namespace, type or enum."""
    code = NOISE.sub(_blank, text)
    code = re.sub(r"^\s*#(?:[^\n]*\\\n)*[^\n]*", _blank, code, flags=re.MULTILINE)
    found = []
    scopes = []  # for every open brace: the line its block began on when it is a function's outermost, else None
    inside = 0   # open braces since that of a function, itself included
    header = ""
    line = header_line = 1
    for c in code:
        if c == "{":
            if inside or not SCOPE.search(re.sub(r"<[^<>]*>|\([^()]*\)", "", header)):
                inside += 1
            scopes.append(header_line if inside == 1 else None)
            header = ""
        elif c == "}" and scopes:
            start = scopes.pop()
            if inside:
                inside -= 1
                if start is not None and line - start + 1 > limit:
                    found.append((start, line - start + 1))
            header = ""
        elif c == ";":
            header = ""
        elif not (c.isspace() and not header):
            if not header:
                header_line = line
            header += c
        line += c == "\n"
    return found
