# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads what a program says to --help: the one place from which manual pages and completions come."""
import re
import subprocess
from dataclasses import dataclass, field

TEXT_COLUMN = 30  # where the texts of options begin
CHOICES = re.compile(r":\{([^}]*)\}")
# Values that are no file; the others may be one.
NUMBER = re.compile(r"^(?:INT|UINT|FLOAT|NUMBER|NONNEGATIVE|POSITIVE)\b")


@dataclass
class Entry:
    """An option, a positional argument or a subcommand: how it is written, and its text."""
    names: list
    value: str
    text: str

    @property
    def choices(self):
        found = CHOICES.search(self.value)
        return found.group(1).split(",") if found else []

    @property
    def takes_value(self):
        return bool(re.match(r"[A-Z]", self.value)) and not self.value.startswith(("Needs:", "Excludes:"))

    @property
    def takes_file(self):
        return self.takes_value and not self.choices and not NUMBER.match(self.value)


@dataclass
class Help:
    description: str = ""
    usage: str = ""
    sections: dict = field(default_factory=dict)  # title -> entries
    footer: str = ""

    def entries(self, *kinds):
        return [entry for title, entries in self.sections.items() for entry in entries
                if any(kind in title.lower() for kind in kinds)]

    @property
    def options(self):
        return [entry for entry in self.entries("") if entry.names[0].startswith("-")]


def read_entry(head, text):
    match = re.match(r"(-[^\s]*(?:, ?-[^\s]*)*|\S+)\s*(.*)", head)
    names = re.split(r", ?", match.group(1)) if head.startswith("-") else [match.group(1)]
    return Entry(names, match.group(2), text)


def split_line(line, next_line):
    """Head and text of an entry's first line. A long head has its text in the next line."""
    wide = re.match(r"  (\S.*?)\s{2,}(\S.*)$", line)
    if wide:
        return wide.groups()
    text_follows = next_line.startswith(" " * TEXT_COLUMN)
    if not text_follows and len(line) > TEXT_COLUMN and line[TEXT_COLUMN - 1] == " ":
        return line[:TEXT_COLUMN].strip(), line[TEXT_COLUMN:].strip()
    return line.strip(), ""


def parse(text):
    result = Help()
    lines = text.splitlines()
    title = None
    for i, line in enumerate(lines):
        if line.startswith("Usage:"):
            result.usage = line[len("Usage:"):].strip()
        elif result.usage and re.fullmatch(r"[A-Z\[][^\s].*:", line):
            title = line.strip(":")
            result.sections[title] = []
        elif title and line.startswith(" " * 20) and result.sections[title]:
            entry = result.sections[title][-1]
            entry.text = f"{entry.text} {line.strip()}".strip()
        elif title and re.match(r"  \S", line):
            head, entry_text = split_line(line, lines[i + 1] if i + 1 < len(lines) else "")
            result.sections[title].append(read_entry(head, entry_text))
        elif line.strip() and not result.usage:
            result.description = f"{result.description} {line.strip()}".strip()
        elif line.strip():
            result.footer = f"{result.footer}\n{line.strip()}".strip()
    if not result.description or not result.options:
        raise ValueError("this is not the help of one of our programs:\n" + text)
    return result


def ask(program):
    """The parsed --help of a program file."""
    return parse(subprocess.run([program, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout)
