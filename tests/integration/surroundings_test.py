# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the daemon needs goes away and comes back: route, interface, tcpq server. It waits, says so, and goes on."""
import os
import socket
import subprocess
import sys

from harness import CLOUDS, HANDLES, PATIENCE_S, STATUS, STOP_WITHIN_S, TYPES, run_tests, wait_until
from tcpq_server import TcpqServer
from traffic import TrafficTest

CONFIG = """
lcm: {retry_longest_s: 0.2}
sources: [{name: camera, channel: GRASPD_CLOUD, policy: all}]
"""
ROUTE = ["239.0.0.0/8", "dev", "lo"]


def ip(*arguments):
    subprocess.run(["ip", *arguments], check=True)


class Surroundings(TrafficTest):
    def answer(self, bus, frame, seq):
        """The daemon's answer, however often the frame must be sent until it is served."""
        data = self.with_seq(frame, seq)

        def answered():
            bus.receive(0.1)
            found = [a for a in bus.on(HANDLES, TYPES["handle_list_t"]) if a.seq == seq]
            if not found:
                try:
                    bus.publish(CLOUDS, data)
                except OSError:
                    pass  # our own network is the one that is away
            return found
        return wait_until(answered, f"the answer to frame {seq}")[0]

    def test_no_route_at_the_start(self):
        frame = self.record_frames(1, width=160)[0]
        ip("route", "del", *ROUTE)
        daemon = self.start("graspd", "--config", self.write_config(CONFIG))
        wait_until(lambda: "event=lcm_away" in daemon.err, "the daemon to say what is missing")
        self.assertIn("ip route add 239.0.0.0/8 dev lo", daemon.err)
        self.assertIsNone(daemon.process.poll())
        ip("route", "add", *ROUTE)
        bus = self.open_bus()
        self.assertEqual(self.answer(bus, frame, 1).source_channel, CLOUDS)
        self.assertEqual(daemon.err.count("event=lcm_away"), 1)
        status = self.await_status(bus, lambda s: s.reconnects == 1, "a status that counts the reconnection")
        self.assertIn("lcm_away", [e.event for e in status.errors])
        code, _ = daemon.stop()
        self.assertEqual(code, 0)

    def keep_cores_busy(self):
        """A process that never sleeps on each core; the function that ends them."""
        hogs = [subprocess.Popen([sys.executable, "-c", f"import os\nos.sched_setaffinity(0, [{core}])\nwhile True: pass"])
                for core in os.sched_getaffinity(0)]

        def end():
            for hog in hogs:
                hog.kill()
                hog.wait()
        self.addCleanup(end)
        return end

    def test_cores_that_others_keep_busy(self):
        frames = self.record_frames(2, width=160)
        bus = self.open_bus()
        daemon = self.start_daemon(bus, self.write_config(CONFIG + "threads: 4\n"))
        alone = self.answer(bus, frames[0], 1)
        end = self.keep_cores_busy()
        wait_until(lambda: "event=threads_a_frame threads=1 most=4" in daemon.err, "the daemon to do without helpers")
        self.assertEqual(vars(self.answer(bus, frames[0], 2))["handles"], vars(alone)["handles"])
        end()
        self.assertEqual(self.answer(bus, frames[1], 3).source_channel, CLOUDS)

    def test_stops_at_once_while_it_waits_for_lcm(self):
        ip("route", "del", *ROUTE)
        self.addCleanup(ip, "route", "add", *ROUTE)
        daemon = self.start("graspd")
        wait_until(lambda: "event=lcm_away" in daemon.err, "the daemon to say what is missing")
        code, _ = daemon.stop()
        self.assertEqual(code, 0)

    def test_route_lost_and_back(self):
        frame = self.record_frames(1, width=160)[0]
        bus = self.open_bus()
        daemon = self.start_daemon(bus, self.write_config(CONFIG))
        self.answer(bus, frame, 1)
        for time in (1, 2):
            ip("route", "del", *ROUTE)
            wait_until(lambda: daemon.err.count("event=lcm_away") == time, "the daemon to notice")
            ip("route", "add", *ROUTE)
            self.answer(bus, frame, 1 + time)
        self.await_status(bus, lambda s: s.reconnects == 2, "a status that counts both")

    def test_interface_down_and_up(self):
        frame = self.record_frames(1, width=160)[0]
        bus = self.open_bus()
        daemon = self.start_daemon(bus, self.write_config(CONFIG))
        self.answer(bus, frame, 1)
        ip("link", "set", "lo", "down")
        wait_until(lambda: "event=lcm_away" in daemon.err, "the daemon to notice")
        ip("link", "set", "lo", "up")
        ip("route", "add", *ROUTE)
        bus = self.open_bus()
        self.assertEqual(self.answer(bus, frame, 2).seq, 2)

    def test_tcpq_server_gone_and_back(self):
        frame = self.record_frames(1, width=160)[0]
        server = TcpqServer()
        server.start()
        daemon = self.start("graspd", "--config", self.write_config(CONFIG), "--lcm-url", server.url)
        status = TYPES["status_t"]
        wait_until(lambda: server.on(STATUS, status), "the first status")
        for seq in range(1, 6):
            server.stop()
            wait_until(lambda: daemon.err.count("event=lcm_away") >= min(seq, 5), "the daemon to notice")
            self.assertIsNone(daemon.process.poll(), daemon.err)
            server.start()
            count = len(server.on(STATUS, status))
            wait_until(lambda: len(server.on(STATUS, status)) > count, "the daemon to be back")
            server.publish(CLOUDS, self.with_seq(frame, seq))
            wait_until(lambda: seq in [a.seq for a in server.on(HANDLES, TYPES["handle_list_t"])], "an answer")
        self.assertEqual(wait_until(lambda: [s for s in server.on(STATUS, status) if s.reconnects == 5],
                                    "a status that counts all")[0].pid, daemon.process.pid)
        self.assertEqual(daemon.stop()[0], 0, daemon.err)
        server.stop()

    def test_no_tcpq_server_at_the_start(self):
        server = TcpqServer()
        daemon = self.start("graspd", "--config", self.write_config(CONFIG), "--lcm-url", server.url)
        wait_until(lambda: "event=lcm_away" in daemon.err, "the daemon to say what is missing")
        self.assertIn("lcm-tcpq-server", daemon.err)
        server.start()
        wait_until(lambda: server.on(STATUS, TYPES["status_t"]), "the first status")
        self.assertEqual(daemon.stop()[0], 0, daemon.err)
        server.stop()

    def test_a_tcpq_server_that_takes_connections_and_says_nothing(self):
        frame = self.record_frames(1, width=160)[0]
        server = TcpqServer()
        server.silent = True
        server.start()
        path = str(self.folder / "notify")
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as systemd:
            systemd.bind(path)
            systemd.settimeout(PATIENCE_S)
            daemon = self.start("graspd", "--config", self.write_config(CONFIG), "--lcm-url", server.url,
                                environment={"NOTIFY_SOCKET": path, "WATCHDOG_USEC": "6000000"})
            told = []
            while sum(message == "WATCHDOG=1" for message in told) < 3:  # over several attempts
                told.append(systemd.recv(4096).decode())
            self.assertNotIn("READY=1", told)
            self.assertTrue([m for m in told if m.startswith("STATUS=waiting for LCM") and "does not answer" in m], told)
            self.assertEqual(daemon.err.count("event=lcm_away"), 1)
            server.silent = False
            while "READY=1" not in told:
                told.append(systemd.recv(4096).decode())
        wait_until(lambda: server.on(STATUS, TYPES["status_t"]), "the first status")
        server.publish(CLOUDS, self.with_seq(frame, 7))
        wait_until(lambda: 7 in [a.seq for a in server.on(HANDLES, TYPES["handle_list_t"])], "an answer")
        server.silent = True
        server.hang_up()
        wait_until(lambda: daemon.err.count("event=lcm_away") == 2, "the daemon to notice")
        code, seconds = daemon.stop()
        self.assertEqual(code, 0, daemon.err)
        self.assertLess(seconds, STOP_WITHIN_S)
        server.stop()

    def test_gives_up_when_told_to(self):
        server = TcpqServer()
        config = self.write_config("lcm: {give_up_s: 0.3, retry_longest_s: 0.1}")
        daemon = self.run_program("graspd", "--config", config, "--lcm-url", server.url, code=1)
        self.assertIn("reason=lcm_away", daemon.err)


if __name__ == "__main__":
    run_tests()
