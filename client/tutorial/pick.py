# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Waits for handles and prints, as one line of JSON, the poses that take an object: python3 pick.py"""
import json
import sys

import graspd
import numpy as np

CLEARANCE_M = 0.004  # detect.check.clearance_m: free on each side of the object
WAY_M = 0.100        # detect.check.way_m: so far back from the grasp the hand's way is free
LIFT_M = 0.100
MIN_SCORE = 0.5


def is_reachable(T):
    """Yours to write: inverse kinematics and collisions of the arm. Here: a box before the robot."""
    return bool(np.all(T[:3, 3] > [0.1, -0.6, 0.0]) and np.all(T[:3, 3] < [1.0, 0.6, 0.8]))


def plan(answer):
    """Of the best handle that can be reached: poses of a frame between the fingertips, in the robot's base frame."""
    for T, handle in zip(graspd.matrices(answer), answer.handles):
        if handle.score < MIN_SCORE:
            break  # the best come first
        grasp = graspd.tool_pose(T, answer.gripper)  # from the object's surface on to the fingertips
        if grasp[0, 0] < 0:
            grasp = grasp @ np.diag([-1.0, -1.0, 1.0, 1.0])  # the same grip, half a turn less for the wrist
        lifted = grasp.copy()
        lifted[2, 3] += LIFT_M  # up in the base frame, not back along the approach
        poses = {"pre_grasp": graspd.pre_grasp(grasp, WAY_M), "grasp": grasp, "lifted": lifted}
        if all(is_reachable(pose) for pose in poses.values()):
            opening_m = min(answer.gripper.aperture, handle.width + 2 * CLEARANCE_M)
            return {"opening_m": opening_m, "object_m": handle.width, **poses}
    return None


def main():
    for answer in graspd.listen(timeout_s=60):
        steps = plan(answer) if answer.status == answer.OK else None
        if steps is None:
            print(f"nothing to pick: {answer.status_text}", file=sys.stderr)
            continue
        print(json.dumps({"utime": answer.utime, "seq": answer.seq, "frame": answer.frame_name, **steps},
                         default=np.ndarray.tolist))
        return 0
    return 1  # no answer for a minute: see config/troubleshooting.md


if __name__ == "__main__":
    sys.exit(main())
