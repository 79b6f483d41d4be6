# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads what graspd-simulate --solids and graspd-detect --format csv have written of the same
frames, and tells which object a handle means.
"""
import csv
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from hand import APERTURE_M, DEPTH_M, THICKNESS_M
from solids import Solid, distance


@dataclass(frozen=True)
class Handle:
    """T_world_hand: the gripper frame of the handle (y the closing axis, z the approach)."""
    rank: int
    score: float
    width_m: float
    T_world_hand: np.ndarray


@dataclass(frozen=True)
class Scene:
    name: str
    solids: list[Solid]
    handles: list[Handle]


def matrix(position: list[float], orientation: list[float]) -> np.ndarray:
    """orientation: a unit quaternion w, x, y, z."""
    rotation = np.zeros(9)
    mujoco.mju_quat2Mat(rotation, np.array(orientation) / np.linalg.norm(orientation))
    T = np.eye(4)
    T[:3, :3] = rotation.reshape(3, 3)
    T[:3, 3] = position
    return T


def read_solid(entry: dict[str, Any]) -> Solid:
    return Solid(entry["kind"], entry["label"], matrix(**entry["T_world_solid"]), entry["parts"],
                 entry.get("cavity"))


def read_handle(row: dict[str, str], T_world_camera: np.ndarray) -> Handle:
    position = [float(row[name]) for name in ("px", "py", "pz")]
    orientation = [float(row[name]) for name in ("qw", "qx", "qy", "qz")]
    return Handle(int(row["id"]), float(row["score"]), float(row["width"]),
                  T_world_camera @ matrix(position, orientation))


def read_scenes(folder: Path, kind: str) -> list[Scene]:
    """Of folder/solids.jsonl and folder/handles.csv, in which frame k is called <kind>k."""
    rows: dict[str, list[dict[str, str]]] = {}
    with open(folder / "handles.csv", encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            rows.setdefault(row["frame"], []).append(row)
    scenes = []
    with open(folder / "solids.jsonl", encoding="utf-8") as file:
        for frame in map(json.loads, file):
            name = f"{kind}{frame['seq']}"
            T_world_camera = matrix(**frame["T_world_camera"])
            handles = [read_handle(row, T_world_camera) for row in rows.pop(name, [])]
            scenes.append(Scene(name, [read_solid(s) for s in frame["solids"]], handles))
    if rows:
        raise ValueError(f"{folder}: handles of frames without solids: {', '.join(rows)}")
    return scenes


def between_the_pads(handle: Handle) -> np.ndarray:
    """Points of the world, 2 mm apart, that the pads sweep over as they close."""
    half_width = min(APERTURE_M, handle.width_m + 0.004) / 2
    axes = [np.arange(-half, half + 1e-9, 0.002) for half in (THICKNESS_M / 2, half_width)]
    axes.append(np.arange(0, DEPTH_M, 0.002))
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    return points @ handle.T_world_hand[:3, :3].T + handle.T_world_hand[:3, 3]


def held_solid(solids: list[Solid], handle: Handle) -> int:
    """The index of the solid that a handle means: that with most matter between the pads; where
    there is none, the object nearest to their middle."""
    points = between_the_pads(handle)
    matter = [int((distance(solid, points) < 0).sum()) for solid in solids]
    if max(matter) > 0:
        return int(np.argmax(matter))
    middle = points.mean(axis=0, keepdims=True)
    objects = [i for i, solid in enumerate(solids) if solid.is_object]
    return min(objects, key=lambda i: float(distance(solids[i], middle)[0]))
