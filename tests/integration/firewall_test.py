# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""config/nftables/graspd.nft between two hosts: what another sends, to our address or the group, no longer arrives."""
import json
import pathlib
import shutil

from harness import CLOUDS, GraspdTest, run_tests
from lcm_udp import Bus
from two_hosts import OTHER_ADDRESS, OUR_ADDRESS, OtherHost, run

RULES = pathlib.Path(__file__).resolve().parents[2] / "config/nftables/graspd.nft"
SEND = """
import socket, struct
from lcm_udp import GROUP, PORT, SHORT
out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
out.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 4)
for number in range(5):
    for address in (GROUP, sys.argv[1]):
        out.sendto(struct.pack(">II", SHORT, number) + sys.argv[2].encode() + b"\\0not a cloud", (address, PORT))
"""


class Firewall(GraspdTest):
    def setUp(self):
        super().setUp()
        if shutil.which("nft") is None:
            self.skipTest("nft(8) is missing")
        try:
            run("nft", "list", "ruleset")
            self.other = OtherHost()
        except OSError as error:
            self.skipTest(str(error))
        self.addCleanup(self.other.close)

    def protect(self):
        run("nft", "--file", str(RULES))
        self.addCleanup(run, "nft", "delete", "table", "inet", "graspd")

    def received(self, count):
        def all_here(status):
            return bool(status.sources) and status.sources[0].received == count
        return self.await_status(self.bus, all_here, f"{count} messages")

    def refused_by_the_kernel(self):
        objects = json.loads(run("nft", "--json", "list", "counter", "inet", "graspd", "refused"))["nftables"]
        return next(o["counter"]["packets"] for o in objects if "counter" in o)

    def test_only_this_machine_is_heard(self):
        self.bus = Bus(OUR_ADDRESS)
        self.addCleanup(self.bus.close)
        self.start_daemon(self.bus)
        self.other.python(SEND, OUR_ADDRESS, CLOUDS)
        self.received(10)  # so it is without the rules: unicast and multicast from another host are taken

        self.protect()
        self.other.python(SEND, OUR_ADDRESS, CLOUDS)
        for _ in range(3):
            self.bus.publish(CLOUDS, b"not a cloud")
        self.received(13)
        self.assertEqual(self.refused_by_the_kernel(), 10)
        self.assertIn(OTHER_ADDRESS, run("ip", "neigh", "show", "dev", "veth0"), "the cable is in use")

    def test_a_forged_address_of_ours_is_not_ours(self):
        """The kernel itself takes no packet from outside that claims to come from one of our addresses."""
        self.bus = Bus(OUR_ADDRESS)
        self.addCleanup(self.bus.close)
        self.protect()
        self.start_daemon(self.bus)
        run(*self.other.command("ip", "address", "add", f"{OUR_ADDRESS}/32", "dev", "lo"))
        forged = SEND.replace("out.setsockopt", f"out.bind(({OUR_ADDRESS!r}, 0))\nout.setsockopt", 1).replace(
            "sys.argv[1])", "GROUP)")
        self.other.python(forged, OUR_ADDRESS, CLOUDS)
        self.bus.publish(CLOUDS, b"not a cloud")
        self.received(1)


if __name__ == "__main__":
    run_tests()
