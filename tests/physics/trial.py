# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""One handle in one scene: the hand comes, closes, lifts, holds and shakes.

Metres, seconds, kilograms.
"""
from collections.abc import Callable
from dataclasses import dataclass, replace

import mujoco
import numpy as np

from hand import JAWS, open_half_m
from model import STEP_S, SceneModel, body_name
from scenes import Handle

WAY_M = 0.10  # that the hand comes straight along the approach
LIFT_M = 0.12
HIGH_LIFT_M = 0.35  # clear of the table, however far the object turns in the jaws
RISEN = 0.8  # share of the lift that the centre of mass takes part in
CLOSING_M_S = 0.1  # each finger
OFF_PLACE_M = 0.005  # of a hand that something is in the way of
LEAST_N = 1e-4  # of a contact that counts
UP = np.array([0.0, 0, 1])


@dataclass(frozen=True)
class Outcome:
    """stage: where it failed; empty when lifted. approach: something keeps the hand from its place;
    close: the jaws do not both meet the object; lift: it is lost on the way up or soon after;
    shake: it is lost then; turn: it stays in the jaws, but hangs down from them.
    lever_m: from the contacts to the centre of mass, in the horizontal plane.
    clear: of everything but the hand, once lifted."""
    stage: str
    lever_m: float
    mass_kg: float
    clear: bool
    carried: bool = False

    @property
    def lifted(self) -> bool:
        return not self.stage


def smooth(share: float) -> float:
    s = min(max(share, 0.0), 1.0)
    return s * s * (3 - 2 * s)


@dataclass(frozen=True)
class Contacts:
    """Of the object with other bodies: their numbers, normal forces [N], places in the world."""
    bodies: np.ndarray
    forces: np.ndarray
    places: np.ndarray

    def middle(self, body: int) -> np.ndarray:
        of_body = self.bodies == body
        return np.average(self.places[of_body], axis=0, weights=self.forces[of_body])


class Trial:
    """A freshly set up scene with the hand before the object."""

    def __init__(self, scene: SceneModel, handle: Handle, target: int) -> None:
        self.scene = scene
        self.T_world_hand = handle.T_world_hand
        self.half_m = open_half_m(handle.width_m)
        start = handle.T_world_hand.copy()
        start[:3, 3] -= WAY_M * start[:3, 2]
        free = scene.near(handle.T_world_hand[:3, 3]) | {target}
        self.model = scene.compile(free, (start, self.half_m))
        self.data = mujoco.MjData(self.model)
        self.object = self.data.body(body_name(target))
        self.hand = self.data.body("hand")
        self.jaws = [self.model.body(name).id for name in JAWS]
        self.hand_parts = {self.hand.id, *self.jaws}
        for name in JAWS:
            self.data.joint(name).qpos = -self.half_m
        self.data.ctrl[3:] = -self.half_m
        scene.hold_unstable(self.model, True)
        mujoco.mj_forward(self.model, self.data)

    def run(self, lift_m: float) -> Outcome:
        self._for(0.2, lambda t: None)
        self._for(0.65, lambda t: self._go(smooth(t / 0.5), UP * 0))
        off_m = np.linalg.norm(self.hand.xpos - self.T_world_hand[:3, 3])
        self._close()
        closed, lever_m = self._in_both_jaws(), self._lever_m()
        self.scene.hold_unstable(self.model, False)
        risen_from = self.object.xipos[2] + RISEN * lift_m
        self._for(1.2, lambda t: self._go(1, UP * lift_m * smooth(t / 0.7)))
        risen, held = self.object.xipos[2] > risen_from, self._in_both_jaws()
        clear = set(self._contacts().bodies) <= self.hand_parts
        self._shake(lift_m)
        at_end = self._in_both_jaws()
        stage = "turn"
        if at_end and risen and self.object.xipos[2] > risen_from:
            stage = ""
        elif not closed:
            stage = "approach" if off_m > OFF_PLACE_M else "close"
        elif not at_end:
            stage = "shake" if held else "lift"
        return Outcome(stage, lever_m, float(self.model.body_mass[self.object.id]), clear)

    def _for(self, duration_s: float, control: Callable[[float], None]) -> None:
        for k in range(round(duration_s / STEP_S)):
            control(k * STEP_S)
            mujoco.mj_step(self.model, self.data)

    def _go(self, share_of_way: float, beyond: np.ndarray) -> None:
        self.data.ctrl[:3] = WAY_M * share_of_way * self.T_world_hand[:3, 2] + beyond

    def _close(self) -> None:
        def close(t: float) -> None:
            # Beyond the middle, so that they press on the thinnest thing with all their force.
            self.data.ctrl[3:] = min(CLOSING_M_S * t - self.half_m, 0.01)

        self._for((self.half_m + 0.01) / CLOSING_M_S + 0.25, close)

    def _shake(self, lift_m: float) -> None:
        """2 cm at 1 Hz along the closing axis and across it, both in the horizontal plane."""
        along = self.T_world_hand[:3, 1] * [1, 1, 0]
        length = np.linalg.norm(along)
        along = along / length if length > 0.1 else np.array([1.0, 0, 0])
        for direction in (along, np.cross(UP, along)):
            def shake(t: float, direction: np.ndarray = direction) -> None:
                swing = 0.02 * np.sin(2 * np.pi * t) * min(1, t / 0.2)
                self._go(1, UP * lift_m + swing * direction)

            self._for(1, shake)
        self._for(0.1, lambda t: None)

    def _contacts(self) -> Contacts:
        contact = self.data.contact
        pairs = self.model.geom_bodyid[contact.geom]
        mine = (pairs == self.object.id).any(axis=1) & (contact.efc_address >= 0)
        bodies = np.where(pairs[:, 0] == self.object.id, pairs[:, 1], pairs[:, 0])[mine]
        forces = self.data.efc_force[contact.efc_address[mine]]
        pressing = forces > LEAST_N
        return Contacts(bodies[pressing], forces[pressing], contact.pos[mine][pressing])

    def _in_both_jaws(self) -> bool:
        return set(self.jaws) <= set(self._contacts().bodies)

    def _lever_m(self) -> float:
        """From between the jaws where they do not both touch the object."""
        contacts, grip = self._contacts(), self.hand.xpos
        if set(self.jaws) <= set(contacts.bodies):
            grip = np.mean([contacts.middle(jaw) for jaw in self.jaws], axis=0)
        return float(np.linalg.norm((self.object.xipos - grip)[:2]))


def try_handle(scene: SceneModel, handle: Handle, target: int) -> Outcome:
    """Lifts it; and higher where it turns in the jaws: its end may still be on the table."""
    outcome = Trial(scene, handle, target).run(LIFT_M)
    if outcome.stage != "turn":
        return replace(outcome, carried=outcome.lifted)
    high = Trial(scene, handle, target).run(HIGH_LIFT_M)
    return replace(outcome, carried=high.stage in ("", "turn") and high.clear)
