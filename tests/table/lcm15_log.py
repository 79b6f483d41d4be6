# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""The same log, written by LCM itself (of PyPI: 1.5): lcm15_log.py IN OUT"""
import sys

import lcm

out = lcm.EventLog(sys.argv[2], "w", overwrite=True)
for event in lcm.EventLog(sys.argv[1], "r"):
    out.write_event(event.timestamp, event.channel, event.data)
out.close()
