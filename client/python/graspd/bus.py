# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Sending clouds and hearing handles over LCM."""
import os
import time

import lcm

from .clouds import make_cloud
from .handle_list_t import handle_list_t


def default_url():
    """As graspd's own programs: LCM_DEFAULT_URL, else a group that stays on this machine."""
    return os.environ.get("LCM_DEFAULT_URL") or "udpm://239.255.76.67:7667?ttl=0"


def connect(url=None):
    """An lcm.LCM."""
    return lcm.LCM(url or default_url())


def listen(channel="GRASPD_HANDLES", url=None, timeout_s=None):
    """Every handle_list_t of the channel as it comes; ends when none has come for timeout_s."""
    bus = connect(url)
    arrived = _subscribe(bus, channel)
    while True:
        if not bus.handle_timeout(1000 if timeout_s is None else max(1, round(1000 * timeout_s))) and timeout_s is not None:
            return
        while arrived:
            yield arrived.pop(0)


def ask(cloud, channel="GRASPD_CLOUD", handles_channel="GRASPD_HANDLES", url=None, timeout_s=5.0):
    """Sends a cloud - an array (N, 3) or a message - and returns the handle_list_t that answers it.

    An answer is told by utime, which is set to the time where it is 0. TimeoutError: none came."""
    message = cloud if hasattr(cloud, "encode") else make_cloud(cloud)
    if message.utime == 0:
        message.utime = time.time_ns() // 1000
    bus = connect(url)
    arrived = _subscribe(bus, handles_channel)
    bus.publish(channel, message.encode())
    end = time.monotonic() + timeout_s
    while True:
        for answer in arrived:
            if answer.utime == message.utime and answer.source_channel == channel:
                return answer
        arrived.clear()
        left = end - time.monotonic()
        if left <= 0:
            raise TimeoutError(f"no answer on {handles_channel} within {timeout_s} s: does graspd run on this LCM URL, "
                               f"{url or default_url()}, with a source on {channel}?")
        bus.handle_timeout(max(1, int(1000 * left)))


def _subscribe(bus, channel):
    """The list that arriving messages are put into."""
    arrived = []
    bus.subscribe(channel, lambda _, data: arrived.append(handle_list_t.decode(data)))
    return arrived
