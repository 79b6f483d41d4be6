# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""A second host: another network namespace at the other end of a virtual cable."""
import os
import pathlib
import subprocess
import sys

from harness import wait_until

HERE = pathlib.Path(__file__).resolve().parent
OUR_ADDRESS, OTHER_ADDRESS = "10.77.0.1", "10.77.0.2"


def run(*command):
    """The command's output; an error shows what it said."""
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if result.returncode != 0:
        raise OSError(f"{' '.join(command)}: {result.stderr.strip()}")
    return result.stdout


class OtherHost:
    """Ours is OUR_ADDRESS on veth0, and our multicast goes there; it is OTHER_ADDRESS. Raises OSError where not allowed."""

    def __init__(self):
        self._holder = subprocess.Popen(["unshare", "--net", "sleep", "100000"])
        self._pid = str(self._holder.pid)
        try:
            ours = os.readlink("/proc/self/ns/net")
            wait_until(lambda: os.readlink(f"/proc/{self._pid}/ns/net") != ours, "the other network namespace", 10)
            run("ip", "link", "add", "veth0", "type", "veth", "peer", "name", "veth1", "netns", self._pid)
            run("ip", "address", "add", f"{OUR_ADDRESS}/24", "dev", "veth0")
            run("ip", "link", "set", "veth0", "up")
            run("ip", "route", "replace", "239.0.0.0/8", "dev", "veth0")
            for command in ("link set lo up", f"address add {OTHER_ADDRESS}/24 dev veth1", "link set veth1 up",
                            "route add 239.0.0.0/8 dev veth1"):
                run(*self.command("ip", *command.split()))
        except (OSError, AssertionError) as error:
            self.close()
            raise OSError(f"no second network namespace with a cable to it: {error}") from None

    def command(self, *command):
        """The same command, to be run there."""
        return ["nsenter", "--target", self._pid, "--net", "--", *map(str, command)]

    def python(self, code, *arguments):
        """Runs Python there, with the test modules at hand."""
        return run(*self.command(sys.executable, "-B", "-c", f"import sys; sys.path.insert(0, {str(HERE)!r})\n{code}",
                                 *arguments))

    def close(self):
        subprocess.run(["ip", "link", "delete", "veth0"], stderr=subprocess.DEVNULL, check=False)
        self._holder.kill()
        self._holder.wait()
