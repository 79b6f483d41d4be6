# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads and writes LCM event logs: a second opinion on what the programs put into files."""
import struct
from collections import namedtuple

SYNC = 0xEDA1DA01
Event = namedtuple("Event", "number utime channel data")


def read_log(path):
    """Every event of a log, which must be whole and numbered from 0."""
    data, at, events = path.read_bytes(), 0, []
    while at < len(data):
        sync, number, utime, name_size, size = struct.unpack_from(">IqqII", data, at)
        if sync != SYNC or number != len(events):
            raise AssertionError(f"{path}: no event {len(events)} at byte {at}")
        at += 28
        events.append(Event(number, utime, data[at:at + name_size].decode(), data[at + name_size:at + name_size + size]))
        at += name_size + size
        if at > len(data):
            raise AssertionError(f"{path}: the last event is cut off")
    return events


def event_bytes(event):
    return struct.pack(">IqqII", SYNC, event.number, event.utime, len(event.channel),
                       len(event.data)) + event.channel.encode() + event.data


def write_log(path, events):
    path.write_bytes(b"".join(event_bytes(event) for event in events))


def write_messages(path, messages, period_s=0.05):
    """(channel, bytes), so far apart."""
    start = 1_700_000_000_000_000
    write_log(path, [Event(number, start + round(number * period_s * 1e6), channel, data)
                     for number, (channel, data) in enumerate(messages)])
