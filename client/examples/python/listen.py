#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Prints handles as CSV: pip install ./client/python; python3 listen.py"""
import graspd

print("frame,px,py,pz,qw,qx,qy,qz,width,score", flush=True)
for answer in graspd.listen():
    for h in answer.handles:
        numbers = [*h.position, *h.orientation, h.width, h.score]
        print(",".join([answer.frame_name, *(f"{n:.6f}" for n in numbers)]), flush=True)
