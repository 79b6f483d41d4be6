# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Solids as the geoms and meshes of MuJoCo's MJCF. Metres, radians."""
import mujoco
import numpy as np
from numpy.typing import ArrayLike

from solids import Body, Solid

ROUND = 'condim="6"'  # round things roll no further than real ones


def text(values: ArrayLike) -> str:
    return " ".join(f"{value:.6g}" for value in np.ravel(values))


def pose_attributes(T: np.ndarray) -> str:
    quaternion = np.zeros(4)
    mujoco.mju_mat2Quat(quaternion, np.ascontiguousarray(T[:3, :3]).ravel())
    return f'pos="{text(T[:3, 3])}" quat="{text(quaternion)}"'


def cylinder(radius: float, z_min: float, z_max: float, more: str = "") -> str:
    return (f'<geom type="cylinder" size="{radius:.6g} {(z_max - z_min) / 2:.6g}" '
            f'pos="0 0 {(z_max + z_min) / 2:.6g}" {more}/>')


def sphere(radius: float, center: list[float]) -> str:
    return f'<geom type="sphere" size="{radius:.6g}" pos="{text(center)}" {ROUND}/>'


def capsule(body: Body) -> str:
    radius, length = body["radius"], np.linalg.norm(np.subtract(body["b"], body["a"]))
    if length < 1e-6:
        return sphere(radius, body["a"])
    ends = f'size="{radius:.6g}" fromto="{text([body["a"], body["b"]])}" {ROUND}'
    if length < 0.04:
        return f'<geom type="capsule" {ends}/>'
    # A cylinder lies in the jaws along a line of contacts, a capsule on one or two.
    return f'<geom type="cylinder" {ends}/>{sphere(radius, body["a"])}{sphere(radius, body["b"])}'


class GeomWriter:
    """Geoms of solids; what meshes they need is in assets. Hollow solids become rings of wedges,
    since MuJoCo takes every mesh as its convex hull."""

    def __init__(self) -> None:
        self.assets: list[str] = []

    def geoms(self, solid: Solid) -> str:
        """In the solid's frame. A cavity is in the first part, others reach into it a little."""
        if solid.cavity is None:
            return "".join(self._body(part) for part in solid.parts)
        hollow = self._hollow(solid.parts[0], solid.cavity)
        return hollow + "".join(self._body(part) for part in solid.parts[1:])

    def _body(self, body: Body) -> str:
        if body["type"] == "box":
            return f'<geom type="box" size="{text(body["half"])}" pos="{text(body["center"])}"/>'
        if body["type"] == "cylinder":
            return cylinder(body["radius"], body["z_min"], body["z_max"], ROUND)
        if body["type"] == "ball":
            return sphere(body["radius"], body["center"])
        if body["type"] == "capsule":
            return capsule(body)
        raise ValueError(f"no geom for a {body['type']}")

    def _hollow(self, outer: Body, cavity: Body) -> str:
        types = outer["type"], cavity["type"]
        radii, z_min = (cavity["radius"], outer["radius"]), outer["z_min"]
        if types == ("cylinder", "cylinder"):
            bottom = cylinder(radii[1], z_min, cavity["z_min"])
            return bottom + self._tube(radii, cavity["z_min"], outer["z_max"])
        if types == ("ball_slice", "ball"):
            foot = cylinder((radii[1] ** 2 - z_min ** 2) ** 0.5, z_min, -radii[0])
            return foot + self._bowl(radii, z_min)
        raise ValueError(f"no geoms for a {types[0]} with a {types[1]} as its cavity")

    def _ring(self, vertices: list[tuple[float, float, float]], count: int) -> str:
        name = f"mesh{len(self.assets)}"
        self.assets.append(f'<mesh name="{name}" vertex="{text(vertices)}"/>')
        turns = 2 * np.pi / count * np.arange(count)
        return "".join(f'<geom type="mesh" mesh="{name}" euler="0 0 {a:.6g}"/>' for a in turns)

    def _tube(self, radii: tuple[float, float], z_min: float, z_max: float) -> str:
        count = 32 if radii[1] < 0.05 else 48
        half = np.pi / count
        balanced = 2 / (1 + np.cos(half))  # chords as far outside the circle as inside
        wedge = [(r * balanced * np.cos(a), r * balanced * np.sin(a), z)
                 for r in radii for a in (-half, half) for z in (z_min, z_max)]
        return self._ring(wedge, count)

    def _bowl(self, radii: tuple[float, float], z_min: float) -> str:
        """The wall from the flat foot at z_min to the rim at 0, in bands of wedges."""
        count, bands = 40, 10
        half = np.pi / count
        polar = np.linspace(np.arccos(-z_min / radii[1]), np.pi / 2, bands + 1)  # 0: straight down
        half_band = (polar[1] - polar[0]) / 2
        balanced = 2 / (1 + np.cos(half)) * 2 / (1 + np.cos(half_band))
        balanced_radii = [balanced * r for r in radii]
        geoms = ""
        for low, high in zip(polar, polar[1:]):
            wedge = [(r * np.sin(t) * np.cos(a), r * np.sin(t) * np.sin(a),
                      max(-r * np.cos(t), z_min))
                     for r in balanced_radii for a in (-half, half) for t in (low, high)]
            geoms += self._ring(wedge, count)
        return geoms
