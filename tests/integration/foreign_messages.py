# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""One frame as a message of each type that graspd understands, by the Python code that lcm-gen makes of the types."""
import importlib
import math
import pathlib
import struct
import subprocess
import zlib
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

    def one_row(self):
        """What was measured, unorganized."""
        points = [p for p in self.points if not math.isnan(p[2])]
        return Frame(len(points), 1, points)


def own_message(frame):
    """The frame as point_cloud_t."""
    data = b"".join(struct.pack("<fff", *p) for p in frame.points)
    fields = [SimpleNamespace(name=n, offset=4 * i, datatype=FLOAT32, count=1) for i, n in enumerate("xyz")]
    return TYPES["point_cloud_t"].encode(
        utime=UTIME, seq=SEQ, frame_name=NAME, viewpoint=[0, 0, 0], width=frame.width, height=frame.height,
        num_fields=3, fields=fields, point_step=12, data_size=len(data), data=data)


class Depth:
    """The frame as 16-bit millimetres, and what packs them."""

    CAMERA = {"fx": 131.25, "fy": 131.25, "cx": 79.5, "cy": 59.5}

    def __init__(self, frame):
        self.width, self.height = frame.width, frame.height
        self.millimetres = [0 if math.isnan(p[2]) else round(1000 * p[2]) for p in frame.points]

    def packed(self, big_endian=False, metres=False):
        """Rounded to float32 as the daemon rounds millimetres, so that both are the same depth."""
        order = ">" if big_endian else "<"
        if not metres:
            return struct.pack(f"{order}{len(self.millimetres)}H", *self.millimetres)
        scale = struct.unpack("f", struct.pack("f", 0.001))[0]
        return struct.pack(f"{order}{len(self.millimetres)}f", *(d * scale for d in self.millimetres))

    def png(self):
        def chunk(name, data):
            return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        data = self.packed(big_endian=True)
        rows = b"".join(b"\0" + data[2 * self.width * v:2 * self.width * (v + 1)] for v in range(self.height))
        return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", self.width, self.height, 16, 0, 0, 0, 0)) +
                chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def own_depth_message(frame):
    """The frame as depth_image_t."""
    depth = Depth(frame)
    data = depth.packed()
    return TYPES["depth_image_t"].encode(utime=UTIME, seq=SEQ, frame_name=NAME, depth_scale=0.001, **Depth.CAMERA,
                                         width=depth.width, height=depth.height, data_size=len(data), data=data)


class Layout:
    """Points packed as somebody might: another field before, bytes left over after each point and each row."""

    def __init__(self, frame, big_endian, wide, one_row):
        frame = frame.one_row() if one_row else frame
        points = frame.points
        self.width, self.height = frame.width, frame.height
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

    def images(self, frame, zipped):
        """images_t: a colour image and the depth."""
        depth = Depth(frame)
        message, colour, image = self._bot_core.images_t(), self._bot_core.image_t(), self._bot_core.image_t()
        colour.size, colour.data = 3, b"rgb"
        image.utime, image.width, image.height, image.row_stride = UTIME, depth.width, depth.height, 2 * depth.width
        image.data = zlib.compress(depth.packed()) if zipped else depth.packed()
        image.size = len(image.data)
        message.utime, message.n_images = UTIME, 2
        message.image_types, message.images = [0, 6 if zipped else 4], [colour, image]
        return message.encode()

    def image_array(self, frame, packing, big_endian=False, metres=False):
        """lcmt_image_array; packing: 0 none, 1 zlib, 3 PNG."""
        depth = Depth(frame)
        message, image = self._drake.lcmt_image_array(), self._drake.lcmt_image()
        image.width, image.height, image.row_stride = depth.width, depth.height, (4 if metres else 2) * depth.width
        data = depth.packed(big_endian, metres)
        image.data = depth.png() if packing == 3 else zlib.compress(data) if packing == 1 else data
        image.size = len(image.data)
        image.bigendian, image.pixel_format = big_endian, 5
        image.channel_type, image.compression_method = 6 if metres else 3, packing
        for header in (message.header, image.header):
            header.seq, header.utime, header.frame_name = SEQ, UTIME, NAME
        message.num_images, message.images = 1, [image]
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
