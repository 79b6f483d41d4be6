# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""What every integration test stands on: a private network, the programs as processes, waiting with a deadline."""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from lcm_types import load_types
from lcm_udp import PORT, URL, Bus

SKIPPED = 77  # what CTest counts as skipped
BIN = pathlib.Path(os.environ.get("GRASPD_BIN", pathlib.Path(__file__).resolve().parents[2] / "build/bin"))
TYPES = load_types()
CLOUDS, HANDLES, STATUS = "GRASPD_CLOUD", "GRASPD_HANDLES", "GRASPD_STATUS"
# How long something may take before the test gives up on it: no measure of speed, only an end to waiting.
SANITIZED = bool(os.environ.get("GRASPD_SANITIZED"))
PATIENCE_S = 300 if SANITIZED else 60
STOP_WITHIN_S = 60 if SANITIZED else 2  # what is promised of the daemon
_INSIDE = "GRASPD_TEST_NAMESPACE"


def skip_all(reason):
    print(f"SKIPPED: {reason}", flush=True)
    sys.exit(SKIPPED)


def _unshare():
    """The command that gives a process a network and mounts of its own, None where that is not allowed."""
    for command in (["unshare", "--net", "--mount"], ["unshare", "--map-root-user", "--net", "--mount"]):
        try:
            if subprocess.run(command + ["true"], stderr=subprocess.DEVNULL, check=False).returncode == 0:
                return command
        except FileNotFoundError:
            break
    return None


def run_tests(argv=None):
    """Runs the calling file's tests in a private network with a multicast route; the end of every test file. argv: for
    unittest, where the file has options of its own."""
    if _INSIDE not in os.environ:
        command = _unshare()
        if command is None:
            skip_all("no private network namespace: unshare(1) is missing or not allowed here")
        os.environ[_INSIDE] = "1"
        os.environ["LCM_DEFAULT_URL"] = URL
        script = os.path.abspath(sys.argv[0])
        setup = 'ip link set lo up && ip route add 239.0.0.0/8 dev lo && exec "$@"'
        arguments = command + ["sh", "-c", setup, "sh", sys.executable, "-B", script] + sys.argv[1:]
        os.execvp(arguments[0], arguments)
    result = unittest.main(argv=argv, exit=False, verbosity=2).result
    everything_skipped = result.testsRun > 0 and len(result.skipped) == result.testsRun
    sys.exit(1 if not result.wasSuccessful() else SKIPPED if everything_skipped else 0)


def wait_until(condition, what, patience_s=PATIENCE_S):
    """Returns condition()'s first true value."""
    deadline = time.monotonic() + patience_s
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > deadline:
            raise AssertionError(f"waited {patience_s} s in vain for {what}")
        time.sleep(0.005)


def listening_sockets():
    """UDP sockets of this network on LCM's port."""
    with open("/proc/net/udp", encoding="ascii") as table:
        return sum(line.split()[1].endswith(f":{PORT:04X}") for line in list(table)[1:])


class Program:
    """A running program; its output goes to files, so that it never waits for us."""

    def __init__(self, folder, name, *arguments, environment=None, stdin=subprocess.DEVNULL):
        self.name = name
        number = len(list(pathlib.Path(folder).glob("*.out")))
        self._paths = [pathlib.Path(folder) / f"{number:02}-{pathlib.Path(name).name}.{end}" for end in ("out", "err")]
        with open(self._paths[0], "wb") as out, open(self._paths[1], "wb") as err:
            self.process = subprocess.Popen([str(BIN / name), *map(str, arguments)], stdin=stdin, stdout=out,
                                            stderr=err, env={**os.environ, **(environment or {})})

    @property
    def out(self):
        return self._paths[0].read_text(encoding="utf-8", errors="replace")

    @property
    def err(self):
        return self._paths[1].read_text(encoding="utf-8", errors="replace")

    def lines(self):
        """The complete lines on standard output so far."""
        return [line[:-1] for line in self.out.splitlines(keepends=True) if line.endswith("\n")]

    def wait(self, patience_s=PATIENCE_S):
        """The exit code, negative for a signal."""
        try:
            return self.process.wait(patience_s)
        except subprocess.TimeoutExpired:
            self.kill()
            raise AssertionError(f"{self.name} did not end in {patience_s} s; standard error:\n{self.err}") from None

    def stop(self, number=signal.SIGTERM):
        """Asks it to end and returns (exit code, seconds that took)."""
        start = time.monotonic()
        self.process.send_signal(number)
        return self.wait(), time.monotonic() - start

    def kill(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()


class GraspdTest(unittest.TestCase):
    """A test with a folder of its own; whatever it started is gone when it ends."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="graspd-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def start(self, name, *arguments, **options):
        program = Program(self.folder, name, *arguments, **options)
        self.addCleanup(program.kill)
        return program

    def run_program(self, name, *arguments, code=0, **options):
        """Runs it to its end, which must come with this exit code."""
        program = self.start(name, *arguments, **options)
        self.assertEqual(program.wait(), code, f"{name} {arguments}\n{program.out[-2000:]}\n{program.err[-4000:]}")
        return program

    def open_bus(self):
        bus = Bus()
        self.addCleanup(bus.close)
        return bus

    def start_listening(self, name, *arguments):
        """Starts a program that subscribes, and waits until its socket is there."""
        before = listening_sockets()
        program = self.start(name, *arguments)
        wait_until(lambda: listening_sockets() > before or program.process.poll() is not None, f"{name} to listen")
        self.assertIsNone(program.process.poll(), f"{name} ended early: {program.err}")
        return program

    @staticmethod
    def probe(bus, channel, data, arrived, what):
        """Sends until it arrives: a socket that is there does not mean yet that the program has subscribed."""
        wait_until(lambda: (bus.publish(channel, data), arrived())[1], what)

    def start_daemon(self, bus, config=None):
        """The daemon, up and serving: its first status has arrived."""
        daemon = self.start_listening("graspd", "--config", config or self.write_config(""))
        self.await_status(bus, lambda status: status.pid == daemon.process.pid, "the daemon's first status")
        return daemon

    def await_status(self, bus, condition, what):
        """The newest status, as soon as one holds the condition."""
        def newest():
            bus.receive(0.02)
            found = [s for s in bus.on(STATUS, TYPES["status_t"]) if condition(s)]
            return found[-1] if found else None
        return wait_until(newest, what)

    def await_answers(self, bus, count, channel=HANDLES):
        """The handle lists of a channel, as soon as there are so many."""
        def enough():
            bus.receive(0.02)
            return len(bus.on(channel)) >= count
        wait_until(enough, f"{count} answers on {channel}")
        return bus.on(channel, TYPES["handle_list_t"])

    def write_config(self, text):
        """A service file. Under a sanitizer, where a frame may take longer than it ever should, the daemon's watchdog
        waits as long as the tests do, unless the text says how long."""
        if SANITIZED and "watchdog_s" not in text:
            text += f"\nwatchdog_s: {PATIENCE_S}\n"
        path = self.folder / "graspd.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    def simulate(self, count, *arguments, width=160 if SANITIZED else 320):
        """A folder of simulated frames."""
        frames = self.folder / "frames"
        self.run_program("graspd-simulate", "--output", frames, "--frames", count, "--new-scene-every", 1,
                         "--width", width, "--seed", 7, *arguments)
        files = sorted(frames.glob("*.pcd"))
        self.assertEqual(len(files), count)
        return frames
