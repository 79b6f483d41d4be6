# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""LCM event logs."""
import struct

SYNC = 0xEDA1DA01


def write_log(path, messages, period_s=0.05):
    """(channel, bytes), so far apart."""
    with open(path, "wb") as log:
        for number, (channel, data) in enumerate(messages):
            name = channel.encode()
            utime = 1_700_000_000_000_000 + round(number * period_s * 1e6)
            log.write(struct.pack(">Iqqii", SYNC, number, utime, len(name), len(data)) + name + data)
