# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the manual page of a program from its --help.

    man_page.py PROGRAM VERSION OUTPUT.1.gz
"""
import gzip
import pathlib
import re
import sys

import help_text

EXIT_STATUS = [("0", "Done, or ended by SIGINT or SIGTERM."), ("1", "Something failed; one line on standard error says what."),
               ("2", "Wrong usage or configuration.")]
URL = ("LCM_DEFAULT_URL", "The LCM URL where neither an option nor a configuration names one.")
DAEMON_FILES = [("/etc/graspd/graspd.yaml", "The configuration, where --config names no other."),
                ("/usr/share/graspd/config", "Grippers, sensors, and every key with its default."),
                ("/usr/lib/sysctl.d/60-graspd.conf", "Buffers of the kernel that large clouds need.")]
OTHERS = ("graspd", "graspd-listen", "graspd-status")


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    text = re.sub(r",(?=\S)", r",\\:", text)  # long lists may break
    return "\n".join("\\&" + line if line[:1] in (".", "'") else line for line in text.splitlines())


def tagged(tag, text):
    return f".TP\n{tag}\n{roff(text) or '.PD'}\n"


def entry(item):
    names = ", ".join(f"\\fB{roff(name)}\\fR" for name in item.names)
    value = f" \\fI{roff(item.value)}\\fR" if item.value else ""
    return tagged(names + value, item.text)


def section(title, body):
    return f".SH {title}\n{body}"


def page(name, version, text):
    short = text.description.rstrip(".")
    short = short[0].lower() + short[1:]
    usage = text.usage.split(maxsplit=1)[1] if len(text.usage.split()) > 1 else ""
    parts = [f'.TH "{name.upper()}" "1" "" "graspd {version}" "User Commands"\n.ad l\n.nh\n',
             section("NAME", f"{roff(name)} \\- {roff(short)}\n"),
             section("SYNOPSIS", f".B {roff(name)}\n{roff(usage)}\n"),
             section("DESCRIPTION", roff(text.description) + "\n")]
    for title, entries in text.sections.items():
        parts.append(section(title.upper(), "".join(map(entry, entries))))
    parts.append(section("EXIT STATUS", "".join(tagged(f"\\fB{code}\\fR", what) for code, what in EXIT_STATUS)))
    if any("--lcm-url" in option.names for option in text.options):
        parts.append(section("ENVIRONMENT", tagged(f"\\fB{URL[0]}\\fR", URL[1])))
    if name == "graspd":
        parts.append(section("FILES", "".join(tagged(f"\\fI{roff(file)}\\fR", what) for file, what in DAEMON_FILES)))
    also = ",\n".join(f"\\fB{roff(other)}\\fR(1)" for other in OTHERS if other != name)
    parts.append(section("SEE ALSO", f"{also}\n.PP\nEverything else: /usr/share/doc/graspd/README.md.gz\n"))
    return "".join(parts)


def main(program, version, output):
    text = page(pathlib.Path(program).name, version, help_text.ask(program))
    with open(output, "wb") as file, gzip.GzipFile(filename="", mode="wb", fileobj=file, compresslevel=9, mtime=0) as packed:
        packed.write(text.encode())


if __name__ == "__main__":
    main(*sys.argv[1:])
