#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Boots graspd's unit in a container with systemd and looks at what systemd made of it.

    mmdebstrap --variant=minbase --include=$(tests/systemd/boot_test.py --packages) bookworm root.tar
    tests/systemd/boot_test.py root.tar           as root, some 60 s; prints a table, exit 0: all as it must be

The container has a network of its own. What it does is in boot_script.sh; it writes what it sees, and is judged here.
"""
import argparse
import contextlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PACKAGES = ["systemd", "systemd-sysv", "dbus", "iproute2", "libtbb12", "libspdlog1.10", "libyaml-cpp0.7", "libsodium23",
            "liblcm1", "libglib2.0-0", "libspng0"]
PROGRAMS = ["graspd", "graspd-simulate", "graspd-status", "graspd-listen"]
DYNAMIC_UIDS = range(61184, 65520)
CHECK_UNIT = """[Unit]
After=multi-user.target
[Service]
Type=oneshot
ExecStart=/bin/bash /boot_script.sh
ExecStopPost=/bin/systemctl poweroff --force --force
StandardOutput=append:/report.log
StandardError=inherit
[Install]
WantedBy=multi-user.target
"""


def make_root(folder, tar, binaries):
    """Unpacks the system and puts graspd into it as the installation does."""
    root = folder / "root"
    root.mkdir()
    subprocess.run(["tar", "-C", root, "--exclude=./dev/*", "-xf", tar], check=True)
    for program in PROGRAMS:
        shutil.copy(binaries / program, root / "usr/bin")
    shutil.copytree(ROOT / "config", root / "usr/share/graspd/config")
    units = root / "etc/systemd/system"
    shutil.copy(ROOT / "config/systemd/graspd.service", units)
    drop_in = units / "graspd.service.d"
    drop_in.mkdir()
    (drop_in / "quick.conf").write_text("[Service]\nWatchdogSec=2\nTimeoutStopSec=3\nTimeoutAbortSec=1\n")
    (root / "etc/graspd").mkdir()
    shutil.copy(HERE / "boot_script.sh", root)
    (units / "check.service").write_text(CHECK_UNIT)
    (units / "multi-user.target.wants").mkdir(exist_ok=True)
    (units / "multi-user.target.wants/check.service").symlink_to("/etc/systemd/system/check.service")
    return root


@contextlib.contextmanager
def memory_group():
    """A command that puts what follows into a memory group of its own, where groups are of version 1: the container's
    systemd sets limits below it."""
    controller = pathlib.Path("/sys/fs/cgroup/memory")
    if not controller.is_dir():
        yield []
        return
    group = controller / f"graspd-boot-{os.getpid()}"
    group.mkdir()
    try:
        yield ["sh", "-c", f'echo $$ > {group}/cgroup.procs && exec "$@"', "sh"]
    finally:
        for path in sorted((p for p in group.rglob("*") if p.is_dir()), reverse=True):
            path.rmdir()
        group.rmdir()


def boot(root, patience_s):
    # systemd's firewall for a unit is a BPF program, which nspawn allows nobody otherwise.
    command = ["systemd-nspawn", "-D", str(root), "--boot", "--private-network", "--register=no", "--keep-unit", "-q",
               "--capability=CAP_BPF", "--system-call-filter=bpf"]
    with open(root.parent / "console.log", "wb") as console, memory_group() as prefix:
        subprocess.run(["unshare", "--mount", *prefix, *command], stdin=subprocess.DEVNULL, stdout=console, stderr=console,
                       timeout=patience_s, check=False)


def read_report(root):
    """key=value lines; the rest is for people."""
    text = (root / "report.log").read_text(encoding="utf-8", errors="replace")
    return dict(re.findall(r"(?m)^([a-z0-9_]+)=(.*)$", text)), text


def checks(seen):
    """(what, holds, what was seen)"""
    def number(key):
        return int(seen.get(key) or -1)

    return [
        ("READY: the start ended when graspd was ready", seen.get("state") == "active", seen.get("state")),
        ("status line for systemctl", bool(seen.get("status_text")), seen.get("status_text")),
        ("DynamicUser in force", number("uid") in DYNAMIC_UIDS, seen.get("uid")),
        ("no capabilities", all(int(seen.get(k) or "1", 16) == 0 for k in ("cap_eff", "cap_prm", "cap_bnd")),
         f"{seen.get('cap_eff')} {seen.get('cap_prm')} {seen.get('cap_bnd')}"),
        ("no new privileges", seen.get("no_new_privs") == "1", seen.get("no_new_privs")),
        ("seccomp filter in force", seen.get("seccomp") == "2" and number("seccomp_filters") > 0,
         f"mode {seen.get('seccomp')}, {seen.get('seccomp_filters')} filters"),
        ("frames are answered inside of all that", number("answers") >= 3, seen.get("answers")),
        ("reload: the same process, a new configuration", seen.get("reload_pid") == seen.get("pid") and
         number("reload_taken") >= 1, f"{seen.get('reload_taken')} taken"),
        ("reload with a bad file: refused, still running", seen.get("bad_reload_pid") == seen.get("pid") and
         number("reload_refused") >= 1, f"{seen.get('reload_refused')} refused"),
        ("watchdog bites a process that stands still", seen.get("watchdog_result") == "yes", seen.get("watchdog_result")),
        ("restarted after it", number("restarts") == 1 and seen.get("restarted_state") == "active" and
         seen.get("restarted_pid") != seen.get("pid"), f"{seen.get('restarts')} restarts"),
        ("the restarted one answers frames", number("answers_again") >= 3, seen.get("answers_again")),
        ("restarted after SIGKILL", number("restarts_after_kill") == 2, f"{seen.get('restarts_after_kill')} restarts"),
        ("IPAddressDeny: what another host sends does not arrive", number("foreign_refused") == 0 and
         number("foreign_refused_without_rule") == 3,
         f"{seen.get('foreign_refused')} of 3, without the rule {seen.get('foreign_refused_without_rule')} of 3"),
        ("what comes from this machine does", number("local_refused") == 1, f"{seen.get('local_refused')} of 1"),
        ("MemoryMax: killed beyond it, and restarted", seen.get("memory_kill") == "yes" and
         number("restarts_after_memory") == 1, f"{seen.get('restarts_after_memory')} restarts"),
        ("the restarted one answers frames", number("answers_after_memory") >= 3, seen.get("answers_after_memory")),
        ("clean stop", seen.get("stop_result") == "success" and seen.get("stop_state") == "inactive" and
         number("stop_ms") < 3000, f"{seen.get('stop_result')}, {seen.get('stop_ms')} ms"),
    ]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("tar", nargs="?", type=pathlib.Path, help="a Debian 12 root file system")
    parser.add_argument("--packages", action="store_true", help="print what the root file system needs")
    parser.add_argument("--bin", type=pathlib.Path, default=pathlib.Path(os.environ.get("GRASPD_BIN", ROOT / "build/bin")))
    parser.add_argument("--patience", type=int, default=300, help="of the whole boot [s]")
    options = parser.parse_args()
    if options.packages:
        print(",".join(PACKAGES))
        return 0
    if options.tar is None or os.geteuid() != 0 or shutil.which("systemd-nspawn") is None:
        print("SKIPPED: needs a root file system, root and systemd-nspawn (Debian: systemd-container)")
        return 77
    with tempfile.TemporaryDirectory(prefix="graspd-boot-") as folder:
        root = make_root(pathlib.Path(folder), options.tar, options.bin)
        boot(root, options.patience)
        if not (root / "report.log").exists():
            print((root.parent / "console.log").read_text(errors="replace")[-3000:], file=sys.stderr)
            return 1
        seen, text = read_report(root)
    results = checks(seen)
    print("| what | result | seen |\n|---|---|---|")
    for what, holds, value in results:
        print(f"| {what} | {'ok' if holds else 'FAILED'} | {value} |")
    if not all(holds for _, holds, _ in results):
        print(text[-8000:], file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
