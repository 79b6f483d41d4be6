# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Grasp handles from graspd over LCM, as numpy arrays: listen(), ask(), matrices(), pre_grasp()."""
__version__ = "0.1.0"

from .control_t import control_t
from .depth_image_t import depth_image_t
from .error_report_t import error_report_t
from .gripper_t import gripper_t
from .handle_list_t import handle_list_t
from .handle_t import handle_t
from .point_cloud_t import point_cloud_t
from .point_field_t import point_field_t
from .reason_count_t import reason_count_t
from .sealed_t import sealed_t
from .segment_t import segment_t
from .segmentation_request_t import segmentation_request_t
from .segmentation_t import segmentation_t
from .source_status_t import source_status_t
from .stage_time_t import stage_time_t
from .status_t import status_t

from .clouds import make_cloud, make_depth_image, points
from .poses import gripper_pose, matrices, pre_grasp, tool_pose
from .bus import ask, connect, default_url, listen

__all__ = [
    "ask", "connect", "default_url", "gripper_pose", "listen", "make_cloud", "make_depth_image", "matrices", "points",
    "pre_grasp", "tool_pose", "control_t", "depth_image_t", "error_report_t", "gripper_t", "handle_list_t", "handle_t",
    "point_cloud_t", "point_field_t", "reason_count_t", "sealed_t", "segment_t", "segmentation_request_t", "segmentation_t",
    "source_status_t", "stage_time_t", "status_t",
]
