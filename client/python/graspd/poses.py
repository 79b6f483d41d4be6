# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Handles as 4x4 matrices.

T takes gripper coordinates to the frame that the list names: origin between the jaws on the object's visible surface,
x = major axis, y = closing axis, z = approach, into the object."""
import numpy as np


def gripper_pose(handle):
    """T of a handle_t, (4, 4)."""
    w, x, y, z = handle.orientation
    T = np.eye(4)
    T[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                 [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                 [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    T[:3, 3] = handle.position
    return T


def matrices(handle_list):
    """T of each handle, best first, (N, 4, 4)."""
    return np.array([gripper_pose(handle) for handle in handle_list.handles]).reshape(-1, 4, 4)


def _moved_along_approach(T, distance_m):
    T = np.array(T, dtype=float)
    T[..., :3, 3] += distance_m * T[..., :3, 2]
    return T


def pre_grasp(T, distance_m=0.1):
    """The same pose so far back along the approach, for one (4, 4) or many (N, 4, 4)."""
    return _moved_along_approach(T, -distance_m)


def tool_pose(T, gripper):
    """Where a tool frame between the fingertips goes: the grasp depth of the list's gripper_t further in."""
    return _moved_along_approach(T, gripper.grasp_depth)
