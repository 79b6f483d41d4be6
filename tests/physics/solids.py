# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""The true solids of graspd-simulate: where their matter is and what it weighs. Metres, kilograms.

A body is what client/simulate/convex.hpp names, as a dictionary of what --solids writes of it.
Points are the rows of an array.
"""
from dataclasses import dataclass
from typing import Any

import numpy as np

Body = dict[str, Any]

FIRST_OBJECT_LABEL = 20
LIGHTEST_KG = 0.02
# Of the matter itself [kg/m3]: boxes and books are not full, most other things neither; vessels are
# of plastic, wood, stoneware and light metal.
DENSITY = {"box": 300, "small_block": 300, "book": 300, "standing_book": 300, "leaning_book": 300,
           "mug": 2000, "cup": 1000, "bowl": 1500, "pan": 2500}
USUAL_DENSITY = 700


@dataclass(frozen=True)
class Solid:
    """The union of its parts, less the cavity; both in the solid's frame."""
    kind: str
    label: int
    T_world_solid: np.ndarray
    parts: list[Body]
    cavity: Body | None = None

    @property
    def is_object(self) -> bool:
        return self.label >= FIRST_OBJECT_LABEL


@dataclass(frozen=True)
class MassProperties:
    """center: of mass, in the solid's frame; inertia: about it, along the solid's axes [kg m2]."""
    mass_kg: float
    center: np.ndarray
    inertia: np.ndarray


def box_distance(body: Body, points: np.ndarray) -> np.ndarray:
    excess = np.abs(points - np.array(body["center"])) - np.array(body["half"])
    outside = np.linalg.norm(np.maximum(excess, 0), axis=1)
    return outside + np.minimum(excess.max(axis=1), 0)


def slab_distance(body: Body, points: np.ndarray) -> np.ndarray:
    return np.maximum(body["z_min"] - points[:, 2], points[:, 2] - body["z_max"])


def cylinder_distance(body: Body, points: np.ndarray) -> np.ndarray:
    side = np.hypot(points[:, 0], points[:, 1]) - body["radius"]
    ends = slab_distance(body, points)
    outside = np.hypot(np.maximum(side, 0), np.maximum(ends, 0))
    return outside + np.minimum(np.maximum(side, ends), 0)


def ball_distance(body: Body, points: np.ndarray) -> np.ndarray:
    return np.linalg.norm(points - np.array(body["center"]), axis=1) - body["radius"]


def ball_slice_distance(body: Body, points: np.ndarray) -> np.ndarray:
    ball = np.linalg.norm(points, axis=1) - body["radius"]
    return np.maximum(ball, slab_distance(body, points))


def capsule_distance(body: Body, points: np.ndarray) -> np.ndarray:
    a, axis = np.array(body["a"]), np.array(body["b"]) - np.array(body["a"])
    share = np.clip((points - a) @ axis / max(axis @ axis, 1e-12), 0, 1)
    return np.linalg.norm(points - a - share[:, None] * axis, axis=1) - body["radius"]


DISTANCES = {"box": box_distance, "cylinder": cylinder_distance, "ball": ball_distance,
             "ball_slice": ball_slice_distance, "capsule": capsule_distance}


def distance_in_solid(solid: Solid, points: np.ndarray) -> np.ndarray:
    """Negative in matter; points in the solid's frame."""
    distance = np.min([DISTANCES[p["type"]](p, points) for p in solid.parts], axis=0)
    if solid.cavity is None:
        return distance
    return np.maximum(distance, -DISTANCES[solid.cavity["type"]](solid.cavity, points))


def distance(solid: Solid, points_world: np.ndarray) -> np.ndarray:
    """The same for points in the world."""
    T = solid.T_world_solid
    return distance_in_solid(solid, (points_world - T[:3, 3]) @ T[:3, :3])


def body_bounds(body: Body) -> tuple[np.ndarray, np.ndarray]:
    if body["type"] == "box":
        center, half = np.array(body["center"]), np.array(body["half"])
        return center - half, center + half
    radius = body["radius"]
    if body["type"] == "ball":
        return np.array(body["center"]) - radius, np.array(body["center"]) + radius
    if body["type"] == "capsule":
        ends = np.array([body["a"], body["b"]])
        return ends.min(axis=0) - radius, ends.max(axis=0) + radius
    return (np.array([-radius, -radius, body["z_min"]]), np.array([radius, radius, body["z_max"]]))


def bounds(solid: Solid) -> tuple[np.ndarray, np.ndarray]:
    """Opposite corners of a box around it, in its frame."""
    corners = [body_bounds(part) for part in solid.parts]
    return np.min([c[0] for c in corners], axis=0), np.max([c[1] for c in corners], axis=0)


def mass_properties(solid: Solid) -> MassProperties:
    """Of the true solid, by points that are the same in every run."""
    num_points = 200_000
    low, high = bounds(solid)
    points = low + (high - low) * np.random.default_rng(1).random((num_points, 3))
    matter = points[distance_in_solid(solid, points) < 0]
    volume = np.prod(high - low) * len(matter) / num_points
    mass = max(LIGHTEST_KG, float(volume) * DENSITY.get(solid.kind, USUAL_DENSITY))
    center = matter.mean(axis=0)
    offset = matter - center
    second = mass * offset.T @ offset / len(matter)
    return MassProperties(mass, center, np.trace(second) * np.eye(3) - second)
