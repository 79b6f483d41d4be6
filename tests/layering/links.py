#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every link of the README files to a file, folder or heading of the repository leads somewhere: links.py FOLDER"""
import pathlib
import re
import sys

LEFT_OUT = {"build", "node_modules", ".git"}


def text_of(path):
    """Without code."""
    return re.sub(r"```.*?```", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)


def anchors(path):
    """What headings can be linked by, as code forges make it of them."""
    headings = re.findall(r"^#+ +(.*)$", text_of(path), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-") for heading in headings}


def broken_links(root):
    for page in sorted(root.rglob("*.md")):
        parts = page.relative_to(root).parts
        if any(part in LEFT_OUT or part.startswith("build-") for part in parts):
            continue
        for link in re.findall(r"\]\(([^)\s]+)\)", text_of(page)):
            if re.match(r"[a-z]+:", link):
                continue
            path, _, anchor = link.partition("#")
            target = page.parent / path if path else page
            if not target.exists():
                yield page, link, "nothing is there"
            elif anchor and target.suffix == ".md" and anchor not in anchors(target):
                yield page, link, "no such heading"


def main(root):
    broken = list(broken_links(root))
    for page, link, why in broken:
        print(f"{page.relative_to(root)}: {link}: {why}")
    print(f"{len(broken)} broken links")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
