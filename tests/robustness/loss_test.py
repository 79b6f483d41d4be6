# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""A camera on another host, and datagrams that get lost: every lost message is counted, and no handle is wrong."""
import shutil
import subprocess
import sys

from trial import (CLOUDS, HANDLES, LIST, MOST_AT_ONCE, SANITIZED, STATUS, TYPES, Camera, Trial, options_of, run_trial, table,
                   wait_until, waiting_bytes)
from two_hosts import HERE, OTHER_ADDRESS, OUR_ADDRESS, OtherHost, run

OPTIONS = options_of(__doc__, messages=30 if SANITIZED else 100, percent=2.0, width=320)
CONFIG = "sources: [{name: camera, channel: GRASPD_CLOUD, policy: all, queue_length: 1000}]\n"
# Sends the message of each line's length on standard input, from the other host.
SENDER = """
import socket, sys
sys.path.insert(0, sys.argv[1])
from lcm_udp import Bus
bus = Bus(sys.argv[2])
bus._socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 4)
while line := sys.stdin.buffer.readline():
    bus.publish(sys.argv[3], sys.stdin.buffer.read(int(line)))
"""


class Loss(Trial):
    def setUp(self):
        super().setUp()
        if shutil.which("iptables") is None:
            self.skipTest("iptables(8) is missing")
        self.message = self.record_messages(1, width=OPTIONS.width)
        try:
            self.other = OtherHost()
            self.addCleanup(self.other.close)
            self.drop(0.5)
            self.drop(0)
        except OSError as error:
            self.skipTest(str(error))

    @staticmethod
    def drop(share):
        """From now on this share of the other host's datagrams is lost; answers, which come back over the same interface,
        are not."""
        run("iptables", "-F", "INPUT")
        if share > 0:
            run("iptables", "-A", "INPUT", "-s", OTHER_ADDRESS, "-p", "udp", "-m", "statistic", "--mode", "random",
                "--probability", str(share), "-j", "DROP")

    def note(self, channel, data):
        """Also what arrives whole: this listener's socket gets just the datagrams that the daemon's gets."""
        if channel == STATUS:
            self.status = TYPES["status_t"].decode(data)
        elif channel == CLOUDS:
            self.arrived.append(int.from_bytes(data[16:24], "big"))
        else:
            self.answers.append(TYPES["handle_list_t"].decode(data))

    def send(self, camera):
        wait_until(lambda: (self.listener.receive(0), waiting_bytes() == 0 and
                            len(self.arrived) - len(self.answers) < MOST_AT_ONCE)[1], "the receivers")
        data = camera.next()
        self.sender.stdin.write(b"%d\n" % len(data) + data)
        self.sender.stdin.flush()
        self.listener.receive(0.005)

    def test_loss(self):
        self.arrived, self.answers, self.status = [], [], None
        self.listener = self.listen(self.note, {CLOUDS, HANDLES, STATUS}, OUR_ADDRESS)
        daemon = self.start_listening("graspd", "--config", self.write_config(CONFIG))
        wait_until(lambda: (self.listener.receive(0.02), self.status)[1], "the first status")
        self.sender = subprocess.Popen(
            self.other.command(sys.executable, "-B", "-c", SENDER, HERE, "10.77.0.2", CLOUDS), stdin=subprocess.PIPE)
        self.addCleanup(self.sender.wait)
        self.addCleanup(self.sender.kill)
        camera = Camera(self.message)
        self.send(camera)
        wait_until(lambda: (self.listener.receive(0.02), self.answers)[1], "the first answer")
        self.drop(OPTIONS.percent / 100)
        while camera.seq < OPTIONS.messages:
            self.send(camera)
        self.drop(0)
        # A loss shows when something comes after it.
        self.send(camera)
        wait_until(lambda: (self.listener.receive(0.02), self.arrived[-1] == camera.seq - 1)[1], "the last message")
        while (count := len(self.answers)) < len(self.arrived):  # each in its time, however long that is
            wait_until(lambda n=count: (self.listener.receive(0.02), len(self.answers) > n)[1], "the next answer")
        wait_until(lambda: (self.listener.receive(0.02), self.status.sources[0].received >= len(self.arrived))[1], "status")
        self.report(camera.seq)
        self.assertEqual(daemon.stop()[0], 0, daemon.err)

    def report(self, sent):
        missing, counted = sent - len(self.arrived), self.status.sources[0].lost
        first = [vars(h) for h in self.answers[0].handles]
        wrong = sum([vars(h) for h in a.handles] != first for a in self.answers if a.status != LIST["OVERLOADED"])
        fragments = -(-len(self.message[0]) // 60000)
        table(("trial", "loss"), ("datagrams lost [%]", f"{OPTIONS.percent:g}"),
              ("messages", f"{sent} of {len(self.message[0]) // 1000} kB, {fragments} datagrams"),
              ("lost, in truth", missing), ("lost, as counted", counted), ("answered", len(self.answers)),
              ("wrong handles", wrong))
        self.assertEqual([a.seq for a in self.answers], self.arrived)
        self.assertEqual(wrong, 0)
        self.assertGreater(len(first), 0)
        self.assertLessEqual(abs(counted - missing), 0.05 * missing)


if __name__ == "__main__":
    run_trial()
