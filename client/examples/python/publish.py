#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Publishes one cloud, a box on a table seen from above: pip install ./client/python; python3 publish.py"""
import graspd
import numpy as np

u, v = np.meshgrid(np.arange(-40, 40), np.arange(-30, 30))
z = np.where((abs(u) < 8) & (abs(v) < 16), 0.74, 0.8)  # metres from the sensor
cloud = graspd.make_cloud(np.stack([u * 0.003, v * 0.003, z], axis=-1), frame_name="python", utime=1, seq=0)
graspd.connect().publish("GRASPD_CLOUD", cloud.encode())
