# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Event logs one after the other in one file become one log: renumber.py IN OUT"""
import struct
import sys

data, at, number = bytearray(open(sys.argv[1], "rb").read()), 0, 0
while at < len(data):
    name_size, size = struct.unpack_from(">II", data, at + 20)
    struct.pack_into(">q", data, at + 4, number)
    at, number = at + 28 + name_size + size, number + 1
open(sys.argv[2], "wb").write(data)
