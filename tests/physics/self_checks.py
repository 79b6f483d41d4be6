# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Trials whose outcome mechanics tells, before those are believed whose outcome nobody knows."""
from dataclasses import dataclass

import numpy as np

from model import SceneModel
from scenes import Handle
from solids import Body, Solid
from trial import try_handle


@dataclass(frozen=True)
class Check:
    """outcome: the stage at which it fails, empty for what is lifted."""
    text: str
    solid: Solid
    handle: Handle
    outcome: str


def at(x: float, y: float, z: float) -> np.ndarray:
    T = np.eye(4)
    T[:3, 3] = x, y, z
    return T


def solid(body: Body, T_world_solid: np.ndarray, cavity: Body | None = None) -> Solid:
    return Solid("thing", 20, T_world_solid, [body], cavity)


def from_above(place: tuple[float, float, float], width_m: float) -> Handle:
    """Jaws that close along the world's y."""
    T = at(*place)
    T[:3, :3] = np.diag([-1, 1, -1])
    return Handle(0, 1.0, width_m, T)


def gripped_ball(latitude_deg: float) -> tuple[Solid, Handle]:
    """A ball that the fingertips touch at that latitude above its equator."""
    radius = 0.04
    latitude = np.radians(latitude_deg)
    top = radius + radius * np.sin(latitude) + 0.03  # the tips are 30 mm below the origin
    handle = from_above((0, 0, top), 2 * radius * np.cos(latitude))
    return solid({"type": "ball", "center": [0, 0, 0], "radius": radius}, at(0, 0, radius)), handle


def lying_bar() -> Solid:
    """400 g, 20 cm long, along the world's x."""
    T = at(0, 0, 0.03)
    T[:3, :3] = [[0, 0, 1], [1, 0, 0], [0, 1, 0]]
    return solid({"type": "cylinder", "radius": 0.03, "z_min": -0.1, "z_max": 0.1}, T)


def checks() -> list[Check]:
    box = {"type": "box", "center": [0, 0, 0.025], "half": [0.025, 0.025, 0.025]}
    on_box = from_above((0, 0, 0.05), 0.05)
    cup = solid({"type": "cylinder", "radius": 0.04, "z_min": 0, "z_max": 0.1}, np.eye(4),
                {"type": "cylinder", "radius": 0.035, "z_min": 0.005, "z_max": 0.2})
    bar, on_bar = lying_bar(), from_above((0, 0, 0.06), 0.06)
    beside = from_above((0.08, 0, 0.06), 0.06)
    return [
        Check("a box gripped at its middle is lifted", solid(box, np.eye(4)), on_box, ""),
        Check("jaws around nothing fail", solid(box, at(0.2, 0, 0)), on_box, "close"),
        Check("a ball 20 degrees above its equator is lifted", *gripped_ball(20), ""),
        Check("a ball 35 degrees above its equator slips out", *gripped_ball(35), "lift"),
        Check("a bar gripped at its middle is lifted", bar, on_bar, ""),
        Check("a bar gripped 8 cm beside its middle turns", bar, beside, "turn"),
        Check("a cup is lifted by its rim", cup, from_above((0, 0.0375, 0.1), 0.005), ""),
    ]


def failed_checks() -> list[str]:
    """What came out otherwise than it has to, in words."""
    failures = []
    for check in checks():
        stage = try_handle(SceneModel([check.solid]), check.handle, 0).stage
        if stage != check.outcome:
            failures.append(f"{check.text}: {f'fails at {stage}' if stage else 'lifted'}")
    return failures
