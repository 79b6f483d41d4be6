# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""One frame as a message of each type that graspd understands, by the Python code that lcm-gen makes of the types."""
import importlib
import math
import pathlib
import struct
import subprocess
from array import array
from types import SimpleNamespace

from harness import TYPES

FOREIGN = pathlib.Path(__file__).resolve().parents[1] / "cross_language/foreign_types"
FLOAT32, FLOAT64 = 7, 8
UTIME, SEQ, NAME = 1_700_000_123_456_789, 41, "camera"


class Frame:
    """An organized cloud: (x, y, z) row by row, NaN where nothing was measured."""

    def __init__(self, width, height, points):
        self.width, self.height, self.points = width, height, points

    @staticmethod
    def of_pcd(path):
        """A binary PCD file whose fields begin with x, y, z as 32-bit floats."""
        header, data = path.read_bytes().split(b"DATA binary\n", 1)
        entries = dict(line.split(" ", 1) for line in header.decode().splitlines() if " " in line)
        assert entries["FIELDS"].startswith("x y z"), entries["FIELDS"]
        step = sum(map(int, entries["SIZE"].split()))
        count = int(entries["POINTS"])
        return Frame(int(entries["WIDTH"]), int(entries["HEIGHT"]),
                     [struct.unpack_from("<fff", data, i * step) for i in range(count)])


def own_message(frame):
    """The frame as point_cloud_t."""
    data = b"".join(struct.pack("<fff", *p) for p in frame.points)
    fields = [SimpleNamespace(name=n, offset=4 * i, datatype=FLOAT32, count=1) for i, n in enumerate("xyz")]
    return TYPES["point_cloud_t"].encode(
        utime=UTIME, seq=SEQ, frame_name=NAME, viewpoint=[0, 0, 0], width=frame.width, height=frame.height,
        num_fields=3, fields=fields, point_step=12, data_size=len(data), data=data)


class Layout:
    """Points packed as somebody might: another field before, bytes left over after each point and each row."""

    def __init__(self, frame, big_endian, wide, one_row):
        points = [p for p in frame.points if not math.isnan(p[2])] if one_row else frame.points
        self.width, self.height = (len(points), 1) if one_row else (frame.width, frame.height)
        self.datatype, size = (FLOAT64, 8) if wide else (FLOAT32, 4)
        self.fields = [("intensity", 0, 4, 1), *((n, 3 + size * i, self.datatype, 1) for i, n in enumerate("xyz"))]
        self.point_step = 3 + 3 * size + 2
        padding = b"" if one_row else b"end"
        self.row_step = self.width * self.point_step + len(padding)
        code = (">" if big_endian else "<") + ("ddd" if wide else "fff")
        packed = [b"iii" + struct.pack(code, *p) + b"pp" for p in points]
        self.data = b"".join(b"".join(packed[r * self.width:(r + 1) * self.width]) + padding for r in range(self.height))
        self.big_endian = big_endian


class Messages:
    """Generates the types' code into a folder, which must be on sys.path."""

    def __init__(self, folder):
        folder.mkdir()
        subprocess.run(["lcm-gen", "--python", "--ppath", folder, *sorted(FOREIGN.glob("*.lcm"))], check=True)
        importlib.invalidate_caches()
        for package in ("drake", "bot_core", "std_msgs", "sensor_msgs"):
            setattr(self, f"_{package}", importlib.import_module(package))

    def drake(self, frame, **layout):
        packed = Layout(frame, **layout)
        message = self._drake.lcmt_point_cloud()
        message.utime, message.frame_name = UTIME, NAME
        for name, offset, datatype, count in packed.fields:
            field = self._drake.lcmt_point_cloud_field()
            field.name, field.byte_offset, field.datatype, field.count = name, offset, datatype, count
            message.fields.append(field)
        message.num_fields = len(message.fields)
        message.filler_size, message.filler = 3, b"any"
        message.flags = 1 if packed.big_endian else 0
        message.data_size = len(packed.data)
        return self._with_sizes(message, packed)

    def bot_core(self, frame, **layout):
        packed = Layout(frame, **layout)
        message = self._bot_core.pointcloud2_t()
        message.utime, message.seq, message.frame_id = UTIME, SEQ, NAME
        message.fields = [self._field(self._bot_core.pointfield_t, *f) for f in packed.fields]
        message.nfields = len(message.fields)
        message.is_bigendian = packed.big_endian
        message.data_nbytes = len(packed.data)
        return self._with_sizes(message, packed)

    def dimos(self, frame, **layout):
        packed = Layout(frame, **layout)
        message = self._sensor_msgs.PointCloud2()
        message.header.seq, message.header.frame_id = SEQ, NAME
        message.header.stamp.sec, message.header.stamp.nsec = UTIME // 10**6, UTIME % 10**6 * 1000
        message.fields = [self._field(self._sensor_msgs.PointField, *f) for f in packed.fields]
        message.fields_length = len(message.fields)
        message.is_bigendian = packed.big_endian
        message.data_length = len(packed.data)
        return self._with_sizes(message, packed)

    def bare(self, frame):
        """pointcloud_t: zeros where nothing was measured."""
        message = self._bot_core.pointcloud_t()
        message.utime, message.seq, message.frame_id = UTIME, SEQ, NAME
        message.points = [(0.0, 0.0, 0.0) if math.isnan(p[2]) else p for p in frame.points]
        message.n_points = len(message.points)
        message.n_channels, message.channel_names = 1, ["intensity"]
        message.channels = [array("f", bytes(4 * message.n_points))]
        return message.encode()

    @staticmethod
    def _field(kind, name, offset, datatype, count):
        field = kind()
        field.name, field.offset, field.datatype, field.count = name, offset, datatype, count
        return field

    @staticmethod
    def _with_sizes(message, packed):
        message.width, message.height = packed.width, packed.height
        message.point_step, message.row_step = packed.point_step, packed.row_step
        message.data = packed.data
        return message.encode()
