#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""The Debian packages in a fresh Debian: lintian, apt install, systemctl start, handles, purge that leaves nothing.

    tests/packaging/deb_test.py      as root; needs what docker/packages.txt lists for 'package', and build/packages/*.deb
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "systemd"))
import boot_test  # noqa: E402  pylint: disable=wrong-import-position
import debian_root  # noqa: E402  pylint: disable=wrong-import-position

BUILD = pathlib.Path(os.environ.get("GRASPD_BUILD", HERE.parents[1] / "build"))
PACKAGES = sorted((BUILD / "packages").glob("*.deb"))
# Where the system writes while it runs, whatever is installed.
RUNNING = ("var/log", "var/cache", "var/lib/apt", "var/lib/dpkg", "var/lib/systemd", "var/lib/dbus", "etc/ld.so.cache", "tmp", "run",
           "proc", "sys", "dev", "var/tmp", "report.log", "etc/machine-id", "etc/resolv.conf", "etc/hostname", "etc/.pwd.lock",
           "root", "packages", "etc/systemd/system/check.service", "etc/systemd/system/multi-user.target.wants/check.service")
PATIENCE_S = 300


def run_in(root, *command):
    """The output of a command in the root, on this machine's network: packages come over it."""
    nspawn = ["systemd-nspawn", "-D", str(root), "--register=no", "--keep-unit", "-q", "--pipe", "--setenv=LC_ALL=C.UTF-8",
              "--setenv=DEBIAN_FRONTEND=noninteractive"]
    result = subprocess.run(["unshare", "--mount", *nspawn, *command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True, check=False)
    if result.returncode != 0:
        raise AssertionError(f"{command}: {result.returncode}\n{result.stdout[-4000:]}")
    return result.stdout


def files_of(root):
    """Every path that a package or a user could have put there."""
    found = set()
    for folder, folders, files in os.walk(root):
        inside = os.path.relpath(folder, root)
        names = {os.path.normpath(os.path.join(inside, name)) for name in folders + files}
        kept = {name for name in names if not name.startswith(tuple(f"{skip}/" for skip in RUNNING)) and name not in RUNNING}
        found |= kept
        folders[:] = [name for name in folders if os.path.normpath(os.path.join(inside, name)) in kept]
    return found


def prepare_boot(root):
    shutil.copy(HERE / "deb_script.sh", root / "boot_script.sh")
    units = root / "etc/systemd/system"
    (units / "check.service").write_text(boot_test.CHECK_UNIT)
    (units / "multi-user.target.wants").mkdir(exist_ok=True)
    (units / "multi-user.target.wants/check.service").symlink_to("/etc/systemd/system/check.service")


class Deb(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        tar = BUILD / "packaging/debian.tar"
        debian_root.make_tar(tar, ["systemd", "systemd-sysv", "dbus", "iproute2", "man-db", "ca-certificates"])
        folder = tempfile.TemporaryDirectory(prefix="graspd-deb-")
        cls.addClassCleanup(folder.cleanup)
        cls.root = root = pathlib.Path(folder.name) / "root"
        root.mkdir()
        subprocess.run(["tar", "-C", root, "--exclude=./dev/*", "-xf", tar], check=True)
        shutil.copy("/etc/resolv.conf", root / "etc/resolv.conf")
        (root / "packages").mkdir()
        for package in PACKAGES:
            shutil.copy(package, root / "packages")
        prepare_boot(root)
        cls.before = files_of(root)
        run_in(root, "apt-get", "update", "-q")
        names = [f"/packages/{package.name}" for package in PACKAGES]
        cls.resolution = run_in(root, "apt-get", "install", "-q", "--simulate", "--no-install-recommends", *names)
        # The others bring a compiler's headers and Java, and have no scripts that could leave something.
        names = [name for name in names if name.startswith(("/packages/graspd_", "/packages/graspd-bench_"))]
        run_in(root, "apt-get", "install", "-q", "-y", "--no-install-recommends", *names)
        cls.installed = files_of(root)
        cls.page = run_in(root, "man", "--where", "graspd-listen")
        boot_test.boot(root, PATIENCE_S)
        cls.seen, cls.report = boot_test.read_report(root)

    def see(self, key, expected):
        self.assertEqual(self.seen.get(key), expected, self.report[-4000:])

    def test_installs_program_settings_and_sysctl(self):
        self.assertIn("usr/bin/graspd", self.installed)
        self.assertIn("usr/lib/sysctl.d/60-graspd.conf", self.installed)
        self.assertIn("etc/graspd/graspd.yaml", self.installed)

    def test_every_package_finds_what_it_depends_on(self):
        for package in PACKAGES:
            self.assertIn(f"\nInst {package.name.split('_')[0]} ", self.resolution)

    def test_every_program_has_a_page_and_a_completion(self):
        programs = [path for path in self.installed if path.startswith("usr/bin/graspd")]
        self.assertGreaterEqual(len(programs), 10)
        self.assertIn("/usr/share/man/man1/graspd-listen.1.gz", self.page)
        for program in programs:
            self.assertIn(f"usr/share/man/man1/{pathlib.Path(program).name}.1.gz", self.installed)
            self.assertIn(f"usr/share/bash-completion/completions/{pathlib.Path(program).name}", self.installed)

    def test_starts_on_demand_alone(self):
        self.see("enabled", "disabled")
        self.see("state_before", "inactive")
        self.see("state", "active")

    def test_answers(self):
        self.see("health", "1")
        self.see("answers", "3")
        self.assertGreater(int(self.seen["handles"]), 0)
        self.see("completion", "json")

    def test_settings_outlive_removal(self):
        self.see("state_reloaded", "active")
        self.see("state_removed", "inactive")
        self.see("settings_kept", "1")

    def test_purge_leaves_nothing(self):
        self.assertIn("purged", self.seen, self.report[-4000:])
        self.see("purged", "")
        left = files_of(self.root) - self.before
        self.assertEqual(sorted(left), [])


class Lintian(unittest.TestCase):
    def test_no_error_and_no_warning(self):
        result = subprocess.run(["lintian", "--allow-root", "--fail-on", "error,warning", *map(str, PACKAGES)], stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stdout)


if __name__ == "__main__":
    missing = debian_root.missing_tools("lintian")
    if os.geteuid() != 0 or missing:
        sys.exit(f"deb_test.py: needs root and {', '.join(missing) or 'nothing else'}")
    if not PACKAGES:
        sys.exit(f"deb_test.py: no packages in {BUILD / 'packages'}: cpack --config build/CPackConfig.cmake")
    unittest.main(verbosity=2)
