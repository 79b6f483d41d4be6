# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""The gripper as MJCF: graspd's default one on three stiff slides, that keep its orientation.

Its frame is that of a handle: x along the pads, y the closing axis, z the approach, the origin
where the handle is. Metres, newtons, seconds.
"""
from collections.abc import Iterable

import numpy as np

from mjcf import pose_attributes, text

# config/grippers/paper_80mm.yaml.
APERTURE_M, WIDTH_M, THICKNESS_M, LENGTH_M, DEPTH_M = 0.080, 0.010, 0.020, 0.060, 0.030
PALM_M = 0.020
JAWS = ("left", "right")  # their bodies and joints
CLEARANCE_M = 0.004  # on each side of the object while the jaws are open
FORCE_N = 25  # of each finger
ARM_FORCE_N = 100  # along each axis of the world
FRICTION = 0.6  # of rubber pads
# A pad is made of tiles, since a pair of geoms has few points of contact: an object would turn
# about those of a single box.
TILES_ALONG, TILES_DOWN = 4, 8
# Of the fingertip: a sharp edge would stand on top of what it should slide beside.
CHAMFER_M = 0.001
CONTACT = ('condim="4" priority="1" solref="0.006 1" solimp="0.9 0.95 0.001" '
           'contype="2" conaffinity="1"')  # not between the fingers
PAD = f'friction="{FRICTION} 0.0012 0.0001" {CONTACT}'


def open_half_m(width_m: float) -> float:
    """Between the middle and each pad while the jaws are open around something of that width."""
    return min(APERTURE_M, width_m + 2 * CLEARANCE_M) / 2


def tile_half() -> tuple[float, float, float]:
    return THICKNESS_M / 2 / TILES_ALONG, WIDTH_M / 2, LENGTH_M / 2 / TILES_DOWN


def tip_asset() -> str:
    """A tile whose lower edges along x are bevelled."""
    x, y, z = tile_half()
    vertices = [(side * x, sign * half, height) for side in (-1, 1) for sign in (-1, 1)
                for half, height in ((y, -z), (y, z - 1.5 * CHAMFER_M), (y - CHAMFER_M, z))]
    return f'<mesh name="tip" vertex="{text(vertices)}"/>'


def finger(name: str, side: int, half_m: float) -> str:
    """side: -1 or 1, of the y axis. Its joint is minus the distance of the pad from the middle."""
    x, y, z = tile_half()
    mass = 0.15 / TILES_ALONG / TILES_DOWN
    geoms = []
    for row in range(TILES_DOWN):
        shape = f'type="box" size="{text((x, y, z))}"' if row else 'type="mesh" mesh="tip"'
        for column in range(TILES_ALONG):
            place = (x * (2 * column + 1) - THICKNESS_M / 2, 0, DEPTH_M - z * (2 * row + 1))
            geoms.append(f'<geom {shape} pos="{text(place)}" mass="{mass}" {PAD}/>')
    return f'''<body name="{name}" pos="0 {side * (half_m + WIDTH_M / 2):.6g} 0" gravcomp="1">
<joint name="{name}" type="slide" axis="0 {-side} 0" ref="{-half_m:.6g}"
 range="{-half_m - 0.002:.6g} 0" armature="0.05"/>{"".join(geoms)}</body>'''


def hand_body(T_world_hand: np.ndarray, half_m: float) -> str:
    axes = zip("xyz", T_world_hand[:3, :3])  # the world's, in the hand
    slides = "".join(f'<joint name="{name}" type="slide" axis="{text(axis)}"/>'
                     for name, axis in axes)
    palm_size = (THICKNESS_M / 2, APERTURE_M / 2 + WIDTH_M, PALM_M / 2)
    palm_place = (0, 0, DEPTH_M - LENGTH_M - PALM_M / 2)
    palm = f'''<geom type="box" size="{text(palm_size)}" pos="{text(palm_place)}"
 mass="1.5" friction="0.4 0.003 0.0001" {CONTACT}/>'''
    return f'''<body name="hand" {pose_attributes(T_world_hand)} gravcomp="1">{slides}{palm}
{finger(JAWS[0], -1, half_m)}{finger(JAWS[1], 1, half_m)}</body>'''


def hand_drives() -> str:
    """Controls: where the hand is to be, x, y, z of the world from its start; both jaws' joints."""
    def drives(joints: Iterable[str], gains: str, force: float) -> str:
        return "".join(f'<position joint="{joint}" {gains} forcerange="{-force} {force}"/>'
                       for joint in joints)

    arm = drives("xyz", 'kp="50000" kv="700"', ARM_FORCE_N)
    fingers = drives(JAWS, 'kp="5000" kv="40"', FORCE_N)
    # As if one motor drove both fingers.
    return f'''<actuator>{arm}{fingers}</actuator>
<equality><joint joint1="left" joint2="right" polycoef="0 1 0 0 0" solref="0.004 1"
 solimp="0.99 0.999 0.001"/></equality>'''
