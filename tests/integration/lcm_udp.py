# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""LCM's UDP multicast protocol on a plain socket: sends what no LCM library would send, sees what really goes out."""
import select
import socket
import struct
import time

GROUP, PORT = "239.255.76.67", 7667
URL = f"udpm://{GROUP}:{PORT}?ttl=0&recv_buf_size=4194304"
SHORT, LONG = 0x4C433032, 0x4C433033  # "LC02": a whole message, "LC03": a fragment
FRAGMENT_BYTES = 60000


class Bus:
    """Sends and receives messages on one interface, given by its address; keeps all that it received, in order."""

    def __init__(self, address="127.0.0.1"):
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM, socket.IPPROTO_UDP)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        if hasattr(socket, "SO_REUSEPORT"):
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
        self._socket.bind((GROUP, PORT))
        membership = socket.inet_aton(GROUP) + socket.inet_aton(address)
        self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)
        self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
        self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton(address))
        self._partial = {}
        self._sequence = 0
        self.messages = []  # (channel, bytes)

    def close(self):
        self._socket.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def send_datagram(self, data):
        self._socket.sendto(data, (GROUP, PORT))

    def publish(self, channel, data):
        """One message, in fragments when it is large."""
        self._sequence += 1
        name = channel.encode() + b"\0"
        if len(data) <= FRAGMENT_BYTES:
            self.send_datagram(struct.pack(">II", SHORT, self._sequence) + name + data)
            return
        chunks = [data[i:i + FRAGMENT_BYTES] for i in range(0, len(data), FRAGMENT_BYTES)]
        for number, chunk in enumerate(chunks):
            header = struct.pack(">IIIIHH", LONG, self._sequence, len(data), number * FRAGMENT_BYTES, number,
                                 len(chunks))
            self.send_datagram(header + (name if number == 0 else b"") + chunk)

    def receive(self, seconds):
        """Takes what arrives within the time, at least what is there already."""
        end = time.monotonic() + seconds
        while True:
            ready, _, _ = select.select([self._socket], [], [], max(0.0, end - time.monotonic()))
            if not ready:
                return
            data, sender = self._socket.recvfrom(65536)
            self._take(data, sender)

    def on(self, channel, wire_type=None):
        """The messages of a channel so far, decoded when a type is given."""
        found = [data for name, data in self.messages if name == channel]
        return [wire_type.decode(data) for data in found] if wire_type else found

    def _take(self, data, sender):
        if len(data) < 8:
            return
        magic, sequence = struct.unpack_from(">II", data)
        if magic == SHORT and b"\0" in data[8:]:
            channel, payload = data[8:].split(b"\0", 1)
            self.messages.append((channel.decode(errors="replace"), payload))
        elif magic == LONG and len(data) >= 20:
            self._take_fragment(data, (sender, sequence))

    def _take_fragment(self, data, key):
        size, offset, number, count = struct.unpack_from(">IIHH", data, 8)
        payload = data[20:]
        if number == 0 and b"\0" not in payload:
            return
        message = self._partial.setdefault(key, {"channel": None, "chunks": {}})
        if number == 0:
            channel, payload = payload.split(b"\0", 1)
            message["channel"] = channel.decode(errors="replace")
        message["chunks"][offset] = payload
        if len(message["chunks"]) == count:
            del self._partial[key]
            whole = b"".join(chunk for _, chunk in sorted(message["chunks"].items()))
            if len(whole) == size:
                self.messages.append((message["channel"], whole))
