# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""A scene as a MuJoCo model: solids on the table, and the gripper. Metres, kilograms, seconds."""
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from hand import hand_body, hand_drives, tip_asset
from mjcf import GeomWriter, pose_attributes, text
from solids import MassProperties, Solid, bounds, mass_properties

STEP_S = 0.002
# Stiff friction (impratio), else everything creeps out of the jaws; no further contacts between two
# convex geoms (multiccd), else what is smooth behind many wedges and tiles catches on their edges.
OPTIONS = f'''<compiler angle="radian" autolimits="true"/><size memory="64M"/>
<option timestep="{STEP_S}" cone="elliptic" impratio="100" integrator="implicitfast"
 iterations="50"><flag multiccd="disable"/></option>
<default><geom friction="0.5 0.003 0.0004" condim="4" solref="0.008 1" solimp="0.9 0.95 0.001"
 mass="0.001"/></default>'''
TABLE = '<geom name="table" type="plane" size="0 0 1"/>'
UNDER_THE_TABLE = {"table", "floor"}  # kinds that the plane stands for


@dataclass(frozen=True)
class Ball:
    """Around an object, in the world."""
    center: np.ndarray
    radius_m: float


def ball_around(solid: Solid) -> Ball:
    low, high = bounds(solid)
    T = solid.T_world_solid
    return Ball(T[:3, :3] @ ((low + high) / 2) + T[:3, 3], float(np.linalg.norm(high - low)) / 2)


def has_moved(body: Any, center: np.ndarray, axes: np.ndarray) -> bool:
    """By more than 2 mm or 2 degrees."""
    turn = axes.reshape(3, 3).T @ body.xmat.reshape(3, 3)
    cosine = (np.trace(turn) - 1) / 2
    return bool(np.linalg.norm(body.xipos - center) > 0.002 or cosine < np.cos(np.radians(2)))


class SceneModel:
    """The solids of a scene and which of them would not stay where they were put.

    Some objects of simulated clutter lean or lie on an edge and would fall over here, before the
    gripper comes. These are held in place, as if by something sticky, until the jaws are closed.
    """

    def __init__(self, solids: list[Solid]) -> None:
        self.solids = solids
        self.objects: dict[int, MassProperties] = {
            i: mass_properties(s) for i, s in enumerate(solids) if s.is_object}
        self._balls = {i: ball_around(solids[i]) for i in self.objects}
        self.unstable: set[int] = set()
        self._find_unstable()

    def compile(self, free: set[int], hand: tuple[np.ndarray, float] | None) -> mujoco.MjModel:
        """free: objects that can move; hand: its pose in the world and how far each jaw is off its
        middle."""
        writer = GeomWriter()
        solids = [i for i, solid in enumerate(self.solids) if solid.kind not in UNDER_THE_TABLE]
        bodies = "".join(self._body(i, i in free, writer) for i in solids)
        gripper, drives = "", ""
        if hand is not None:
            writer.assets.append(tip_asset())
            gripper, drives = hand_body(*hand), hand_drives()
        return mujoco.MjModel.from_xml_string(
            f'<mujoco>{OPTIONS}<asset>{"".join(writer.assets)}</asset>'
            f'<worldbody>{TABLE}{bodies}{gripper}</worldbody>{drives}</mujoco>')

    def near(self, point: np.ndarray) -> set[int]:
        """The objects that what happens at that point can reach."""
        gaps = {i: float(np.linalg.norm(ball.center - point)) for i, ball in self._balls.items()}
        return {i for i, gap in gaps.items() if gap < 0.25 or gap - self._balls[i].radius_m < 0.06}

    def hold_unstable(self, model: mujoco.MjModel, held: bool) -> None:
        for i in self.unstable:
            body = model.body(body_name(i)).id
            if model.body_dofnum[body] == 0:
                continue
            first = model.body_dofadr[body]
            rate = 40 if held else 0  # [1/s]
            model.dof_damping[first:first + 3] = rate * model.body_mass[body]
            model.dof_damping[first + 3:first + 6] = rate * model.body_inertia[body].sum()
            model.body_gravcomp[body] = held

    def _body(self, i: int, free: bool, writer: GeomWriter) -> str:
        solid, joint = self.solids[i], ""
        if free:
            mass = self.objects[i]
            inertia = mass.inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
            joint = (f'<freejoint/><inertial pos="{text(mass.center)}" mass="{mass.mass_kg:.6g}" '
                     f'fullinertia="{text(inertia)}"/>')
        # What has this attribute when it is compiled can have it switched on and off.
        held = 'gravcomp="1"' if free and i in self.unstable else ""
        return (f'<body name="{body_name(i)}" {pose_attributes(solid.T_world_solid)} {held}>'
                f'{joint}{writer.geoms(solid)}</body>')

    def _find_unstable(self) -> None:
        """Until the rest stays: what one carries away may itself be at fault."""
        for _ in range(5):
            moved = self._moved_by_themselves()
            if not moved:
                return
            self.unstable |= moved

    def _moved_by_themselves(self) -> set[int]:
        """The first that do, within half a second."""
        model = self.compile(set(self.objects), None)
        data = mujoco.MjData(model)
        self.hold_unstable(model, True)
        mujoco.mj_forward(model, data)
        bodies = {i: data.body(body_name(i)) for i in self.objects}
        start = {i: (body.xipos.copy(), body.xmat.copy()) for i, body in bodies.items()}
        for _ in range(5):
            mujoco.mj_step(model, data, 50)
            moved = {i for i, body in bodies.items() if has_moved(body, *start[i])} - self.unstable
            if moved:
                return moved
        return set()


def body_name(i: int) -> str:
    return f"solid{i}"
