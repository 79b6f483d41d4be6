# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""A fresh Debian 12 root file system, from the mirrors that this machine uses."""
import pathlib
import re
import shutil
import subprocess

SUITE = "bookworm"
TOOLS = ["mmdebstrap", "systemd-nspawn"]


def one_line(stanza):
    """A deb822 stanza of Debian's own archive as lines of sources.list; nothing for others' archives."""
    fields = dict(re.findall(r"(?m)^([A-Za-z-]+):\s*(.*)$", stanza))
    suites = [suite for suite in fields.get("Suites", "").split() if suite.startswith(SUITE)]
    if "deb" not in fields.get("Types", "").split() or not suites:
        return []
    key = f"[signed-by={fields['Signed-By']}] " if fields.get("Signed-By", "").startswith("/") else ""
    return [f"deb {key}{uri} {suite} {fields.get('Components', 'main')}" for uri in fields.get("URIs", "").split()
            for suite in suites]


def is_debian(line):
    words = re.sub(r"\[[^]]*\]", "", line).split()
    return len(words) >= 4 and words[0] == "deb" and re.fullmatch(SUITE + r"(-updates|-security)?", words[2]) is not None


def mirrors(apt=pathlib.Path("/etc/apt")):
    """Lines for sources.list: this machine's, of this suite."""
    lines = []
    for file in [apt / "sources.list", *sorted((apt / "sources.list.d").glob("*.list"))]:
        if file.exists():
            lines += file.read_text(encoding="utf-8").splitlines()
    for file in sorted((apt / "sources.list.d").glob("*.sources")):
        for stanza in re.split(r"\n\s*\n", file.read_text(encoding="utf-8")):
            lines += one_line(stanza)
    return [line for line in lines if is_debian(line)]


def missing_tools(*more):
    return [tool for tool in [*TOOLS, *more] if shutil.which(tool) is None]


def make_tar(tar, packages, *options):
    """Writes a root file system with these packages; the same file again where it is there already."""
    if tar.exists():
        return
    lines = mirrors()
    if not lines:
        raise RuntimeError(f"this machine's sources of packages name no {SUITE}")
    tar.parent.mkdir(parents=True, exist_ok=True)
    part = tar.with_suffix(".part.tar")
    subprocess.run(["mmdebstrap", "--variant=minbase", "--quiet", f"--include={','.join(packages)}", *options, SUITE, str(part),
                    *lines], check=True, stdin=subprocess.DEVNULL)
    part.rename(tar)
