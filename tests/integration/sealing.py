# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Seals messages by the text of lcmtypes/sealed_t.lcm alone, rightly and wrongly."""
import hashlib
import itertools
import secrets
import struct
import time

from harness import TYPES


def now_us():
    return time.time_ns() // 1000


class Sealer:
    """A sender with a key, as bytes."""

    def __init__(self, key):
        self.key = key
        self.key_id = struct.unpack(">q", hashlib.blake2b(key, digest_size=32).digest()[:8])[0]
        self.sender = struct.unpack(">q", secrets.token_bytes(8))[0]
        self._numbers = itertools.count(1)

    @classmethod
    def from_file(cls, key_file):
        """With the key that graspd-keygen wrote."""
        return cls(bytes.fromhex(key_file.read_text(encoding="ascii")))

    def seal(self, channel, message, **changes):
        """The sealed message; changes to its members are signed, too."""
        members = dict(key_id=self.key_id, sender=self.sender, seq=next(self._numbers), utime=now_us(),
                       payload_size=len(message), payload=message, mac=bytes(32))
        unsigned = TYPES["sealed_t"].encode(**{**members, **changes})[:-32]
        signed = struct.pack(">Q", len(channel)) + channel.encode() + unsigned
        return unsigned + hashlib.blake2b(signed, key=self.key, digest_size=32).digest()
