# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Clouds and depth images between messages and numpy."""
import numpy as np

from .depth_image_t import depth_image_t
from .point_cloud_t import point_cloud_t
from .point_field_t import point_field_t

_DTYPES = {point_field_t.INT8: "i1", point_field_t.UINT8: "u1", point_field_t.INT16: "<i2", point_field_t.UINT16: "<u2",
           point_field_t.INT32: "<i4", point_field_t.UINT32: "<u4", point_field_t.FLOAT32: "<f4",
           point_field_t.FLOAT64: "<f8"}


def make_cloud(xyz, frame_name="camera", utime=0, seq=0, viewpoint=(0.0, 0.0, 0.0)):
    """A point_cloud_t of an array (N, 3) or, organized, (H, W, 3), in metres; NaN marks missing points.

    viewpoint: origin of the sensor in the frame of the points [m]."""
    xyz = np.asarray(xyz, dtype="<f4")
    if xyz.ndim not in (2, 3) or xyz.shape[-1] != 3:
        raise ValueError(f"points of shape {xyz.shape}, expected (N, 3) or (H, W, 3)")
    cloud = point_cloud_t()
    cloud.utime, cloud.seq, cloud.frame_name, cloud.viewpoint = int(utime), int(seq), frame_name, [*map(float, viewpoint)]
    cloud.height, cloud.width = (1, len(xyz)) if xyz.ndim == 2 else xyz.shape[:2]
    for i, name in enumerate("xyz"):
        field = point_field_t()
        field.name, field.offset, field.datatype, field.count = name, 4 * i, point_field_t.FLOAT32, 1
        cloud.fields.append(field)
    cloud.num_fields, cloud.point_step = 3, 12
    cloud.data = xyz.tobytes()
    cloud.data_size = len(cloud.data)
    return cloud


def make_depth_image(depth, fx, fy, cx, cy, frame_name="camera", utime=0, seq=0, depth_scale=0.001):
    """A depth_image_t of an array (H, W): along z, 0 where nothing was measured, in units of depth_scale [m].

    fx, fy, cx, cy: focal lengths and principal point [pixels]; pixel (u, v) has its centre at (u, v)."""
    depth = np.asarray(depth)
    if depth.ndim != 2:
        raise ValueError(f"depth of shape {depth.shape}, expected (H, W)")
    if depth.size and (depth.min() < 0 or depth.max() > 65535):
        raise ValueError("depths do not fit 16 bits, expected 0 to 65535")
    image = depth_image_t()
    image.utime, image.seq, image.frame_name = int(utime), int(seq), frame_name
    image.depth_scale, image.fx, image.fy, image.cx, image.cy = map(float, (depth_scale, fx, fy, cx, cy))
    image.height, image.width = depth.shape
    image.data = depth.astype("<u2").tobytes()
    image.data_size = len(image.data)
    return image


def points(message):
    """The points of a point_cloud_t or a depth_image_t as float32 (N, 3), row by row; missing ones are NaN."""
    return _points_of_image(message) if isinstance(message, depth_image_t) else _points_of_cloud(message)


def _points_of_cloud(cloud):
    count = cloud.width * cloud.height
    fields = {field.name: field for field in cloud.fields}
    layout = np.dtype({"names": list("xyz"), "formats": [_DTYPES[fields[n].datatype] for n in "xyz"],
                       "offsets": [fields[n].offset for n in "xyz"], "itemsize": cloud.point_step})
    packed = np.frombuffer(cloud.data, dtype=layout, count=count)
    return np.stack([packed[n].astype(np.float32) for n in "xyz"], axis=1)


def _points_of_image(image):
    depth = np.frombuffer(image.data, dtype="<u2").reshape(image.height, image.width)
    # Rounded as often as the daemon rounds, so that both see the same points.
    z = np.where(depth == 0, np.float32("nan"), depth.astype(np.float32) * np.float32(image.depth_scale))
    columns = ((np.arange(image.width) - image.cx) / image.fx).astype(np.float32)
    rows = ((np.arange(image.height) - image.cy) / image.fy).astype(np.float32)
    return np.stack([columns[None, :] * z, rows[:, None] * z, z], axis=-1).reshape(-1, 3)
