#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the inputs that the fuzzers start from into tests/fuzz/corpus: small, valid, and each of another kind.

What the fuzzers put in front themselves (fingerprints) is left out.
"""
import pathlib
import struct
import sys
import zlib
from types import SimpleNamespace

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "integration"))
from lcm_types import load_types  # noqa: E402

TYPES = load_types()
FOREIGN = load_types(HERE.parent / "cross_language/foreign_types")
ROOT = HERE.parents[1]


def write(target, name, data):
    folder = HERE / "corpus" / target
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(data if isinstance(data, bytes) else data.encode())


def compact(*fields):
    """A struct in Thrift's compact protocol: (id, type, payload) in the order of the ids."""
    data, last = b"", 0
    for number, kind, payload in fields:
        data += bytes([(number - last) << 4 | kind]) + payload
        last = number
    return data + b"\0"


def varint(value):
    data = b""
    while value >= 0x80:
        data, value = data + bytes([value & 0x7f | 0x80]), value >> 7
    return data + bytes([value])


def zigzag(value):
    return varint(value << 1)


def text(value):
    return varint(len(value)) + value


def parquet(pages, codec):
    """A table of two rows: number as int64 (2), text as bytes (6). codec: 0 plain, 6 zstd, as one block that is not compressed."""
    i32, i64, binary, array, struct_ = 5, 6, 8, 9, 12
    body, chunks = b"PAR1", b""
    for kind, name, page in pages:
        packed = page
        if codec == 6:
            packed = (b"\x28\xb5\x2f\xfd\x20" + bytes([len(page)]) + struct.pack("<I", len(page) << 3 | 1)[:3] + page)
        counts = compact((1, i32, zigzag(2)), (2, i32, zigzag(0)), (3, i32, zigzag(3)), (4, i32, zigzag(3)))
        chunk = compact((1, i32, zigzag(0)), (2, i32, zigzag(len(page))), (3, i32, zigzag(len(packed))),
                        (5, struct_, counts)) + packed
        meta = compact((1, i32, zigzag(kind)), (4, i32, zigzag(codec)), (7, i64, zigzag(len(chunk))),
                       (9, i64, zigzag(len(body))))
        chunks += compact((3, struct_, meta))
        body += chunk
    schema = compact((4, binary, text(b"schema")), (5, i32, zigzag(len(pages))))
    schema += b"".join(compact((1, i32, zigzag(k)), (3, i32, zigzag(0)), (4, binary, text(n))) for k, n, _ in pages)
    group = compact((1, array, bytes([len(pages) << 4 | struct_]) + chunks), (3, i64, zigzag(2)))
    footer = compact((1, i32, zigzag(1)), (2, array, bytes([len(pages) + 1 << 4 | struct_]) + schema), (3, i64, zigzag(2)),
                     (4, array, bytes([1 << 4 | struct_]) + group), (6, binary, text(b"graspd")))
    return body + footer + struct.pack("<I", len(footer)) + b"PAR1"


def point_cloud(points, width=None):
    fields = [TYPES["point_field_t"].encode(name=n, offset=4 * i, datatype=7, count=1)[8:] for i, n in enumerate("xyz")]
    data = b"".join(struct.pack("<fff", *p) for p in points)
    width = len(points) if width is None else width
    head = struct.pack(">qq", 1, 2) + struct.pack(">i", 2) + b"f\0" + struct.pack(">ddd", 0, 0, 0)
    head += struct.pack(">iii", width, len(points) // width if width else 0, 3) + b"".join(fields)
    return head + struct.pack(">ii", 12, len(data)) + data


def depth_image(depths, width, focal_length=200.0):
    data = b"".join(struct.pack("<H", d) for d in depths)
    head = struct.pack(">qq", 1, 2) + struct.pack(">i", 2) + b"f\0"
    head += struct.pack(">ddddd", 0.001, focal_length, focal_length, width / 2, 12.0)
    return head + struct.pack(">iii", width, len(depths) // width, len(data)) + data


def patch(corner, columns, rows, step=0.003):
    """A flat piece facing the sensor."""
    return [(corner[0] + i * step, corner[1] + j * step, corner[2]) for j in range(rows) for i in range(columns)]


def detect_seeds():
    table, box = patch((-0.02, -0.02, 0.6), 12, 12), patch((-0.01, -0.01, 0.56), 7, 6)
    clouds = {
        "box_on_table": table + box,
        "box_alone": box,
        "line": [(0.001 * i, 0, 0.5) for i in range(60)],
        "one_place": [(0.1, 0.2, 0.5)] * 60,
        "huge_and_tiny": [(1e30, 0, 0.5), (0, -3e38, 0.5), (1e-45, -1e-45, 1e-40), (0, 0, 0.5)] * 4,
        "nothing_finite": [(float("nan"), float("inf"), float("-inf"))] * 6,
        "no_points": [],
    }
    for name, points in clouds.items():
        write("detect", f"cloud_{name}", b"\0" + point_cloud(points))
    depths = [0 if i % 16 == 2 else 560 if 5 <= i % 16 < 11 and 4 <= i // 16 < 10 else 600 for i in range(16 * 14)]
    write("detect", "image_box_on_table", b"\1" + depth_image(depths, 16))
    write("detect", "image_steps", b"\3" + depth_image([500 + 4 * (i // 16) for i in range(16 * 14)], 16))


def foreign_seeds():
    """Two points each: big-endian float64 behind another field in two rows, little-endian float32 in one."""
    def fields(datatype, place, start=0, **more):
        size = {7: 4, 8: 8}[datatype]
        return [SimpleNamespace(name=n, datatype=datatype, count=1, **{place: start + size * i}, **more)
                for i, n in enumerate("xyz")]
    big = b"".join(b"\7" + struct.pack(">ddd", 1, 2, 3) + b"--" for _ in range(2))
    little = struct.pack("<ffffff", 1, 2, 3, 0, 0, 0)
    drake, dimos = FOREIGN["lcmt_point_cloud"], FOREIGN["PointCloud2"]
    bot_core, bare = FOREIGN["pointcloud2_t"], FOREIGN["pointcloud_t"]
    one = dict(utime=1, frame_name="f", num_fields=3, filler_size=1, filler=b"x")
    header = SimpleNamespace(seq=2, stamp=SimpleNamespace(sec=1, nsec=2000), frame_id="f")
    seeds = {
        "drake_big": (0, drake.encode(**one, width=1, height=2, fields=fields(8, "byte_offset", 1), flags=1, point_step=25,
                                      row_step=27, data_size=len(big), data=big)),
        "drake_little": (0, drake.encode(**one, width=2, height=1, fields=fields(7, "byte_offset"), flags=2, point_step=12,
                                         row_step=0, data_size=24, data=little)),
        "bot_core": (1, bot_core.encode(utime=1, seq=2, frame_id="f", height=2, width=1, nfields=3,
                                        fields=fields(8, "offset", 1), is_bigendian=1, point_step=25, row_step=27,
                                        data_nbytes=len(big), data=big, is_dense=0)),
        "bare": (2, bare.encode(utime=1, seq=2, frame_id="f", n_points=2, points=[[1, 2, 3], [0, 0, 0]], n_channels=1,
                                channel_names=["r"], channels=[[1, 2]])),
        "dimos": (3, dimos.encode(fields_length=3, data_length=24, header=header, height=1, width=2,
                                  fields=fields(7, "offset"), is_bigendian=0, point_step=12, row_step=24, data=little,
                                  is_dense=1)),
    }
    for name, (kind, message) in seeds.items():
        write("foreign_cloud", name, bytes([kind]) + message[8:])


def png16(width, height, numbers):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    rows = b"".join(b"\0" + struct.pack(f">{width}H", *numbers[width * v:width * (v + 1)]) for v in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def image_seeds():
    """Two by two pixels each, in every format and packing."""
    numbers = [1000, 0, 65535, 2000]
    raw = struct.pack("<4H", *numbers)
    metadata = SimpleNamespace(key="k", n=2, value=b"vv")
    for name, kind, data in (("raw", 4, raw), ("zlib", 6, zlib.compress(raw)), ("colour", 0, raw), ("no_zlib", 6, raw)):
        image = SimpleNamespace(utime=1, width=2, height=2, row_stride=4, pixelformat=-1, size=len(data), data=data,
                                nmetadata=1, metadata=[metadata])
        message = FOREIGN["images_t"].encode(utime=1, n_images=1, image_types=[kind], images=[image])
        write("foreign_image", f"bot_core_{name}", b"\0" + message[8:])
    header = SimpleNamespace(seq=2, utime=1, frame_name="f")
    floats = struct.pack("<4f", 1, 0, float("inf"), 2)
    for name, kind, packing, data in (("raw", 3, 0, raw), ("zlib", 3, 1, zlib.compress(raw)), ("png", 3, 3, png16(2, 2, numbers)),
                                      ("float", 6, 0, floats), ("float_zlib", 6, 1, zlib.compress(floats)),
                                      ("png_of_another_size", 3, 3, png16(1, 2, numbers)), ("jpeg", 3, 2, raw)):
        image = SimpleNamespace(header=header, width=2, height=2, row_stride=8 if kind == 6 else 4, size=len(data), data=data,
                                bigendian=0, pixel_format=5, channel_type=kind, compression_method=packing)
        message = FOREIGN["lcmt_image_array"].encode(header=header, num_images=1, images=[image])
        write("foreign_image", f"drake_{name}", b"\1" + message[8:])


def config_seeds():
    for gripper in sorted((ROOT / "config/grippers").glob("*.yaml")):
        write("gripper_config", gripper.stem, gripper.read_bytes())
    for sensor in sorted((ROOT / "config/sensors").glob("*.yaml")):
        write("sensor_config", sensor.stem, sensor.read_bytes())
    write("service_config", "two_sources", """lcm: {status_channel: S}
workers: 3
on_stop: drop
limits: {max_points: 1000, max_sources: 4}
detect:
  workspace: {min_m: [-1, -1, 0], max_m: [1, 1, 2.5]}
  downsample: {leaf_size_m: 4e-3}
sources:
  - name: a
    channel: A_.*
    policy: all
    gripper: {aperture_m: 0.08, finger_width_m: 0.01, finger_thickness_m: 0.02, finger_length_m: 0.06, grasp_depth_m: 0.03, min_gap_m: 0.012}
    sensor_pose: {frame_name: base, position_m: [0, 0, 1], rpy_rad: [3.14, 0, 1.57]}
  - {name: b, channel: B, handles_channel: HB, detect: {ranking: {max_handles: 2}}}
""")
    write("service_config", "aliases", "a: &a {min_m: [0, 0, 0]}\ndetect: {workspace: *a}\n")
    bomb = "a: &a [x, x]\n" + "".join(f"{c}: &{c} [*{p}, *{p}, *{p}, *{p}, *{p}, *{p}, *{p}, *{p}, *{p}]\n"
                                      for p, c in zip("abcdefgh", "bcdefghi")) + "sources: *i\n"
    for target in ("service_config", "gripper_config", "sensor_config"):
        write(target, "alias_bomb", bomb)
        write(target, "deep_flow", "a: " + "[" * 600)
        write(target, "deep_map", "".join(" " * i + "a:\n" for i in range(80)))
        write(target, "deep_list", "- " * 600)
        write(target, "own_alias", "&a [*a]\n")
        write(target, "not_a_number", "aperture_m: .nan\ndetect: {downsample: {leaf_size_m: 1e400}}\n")


def pcd(kind, data, fields="x y z", sizes="4 4 4", types="F F F", width=2, height=1):
    header = f"# .PCD v0.7\nVERSION 0.7\nFIELDS {fields}\nSIZE {sizes}\nTYPE {types}\nWIDTH {width}\nHEIGHT {height}\n"
    return (header + f"VIEWPOINT 0 0 1 1 0 0 0\nPOINTS {width * height}\nDATA {kind}\n").encode() + data


def pcd_seeds():
    packed = struct.pack("<6f", 1, 2, 3, 4, 5, float("nan"))
    write("pcd", "ascii", pcd("ascii", b"1 2 3\n4 nan 6\n"))
    write("pcd", "binary", pcd("binary", packed))
    literal = bytes([len(packed) - 1]) + packed
    write("pcd", "compressed", pcd("binary_compressed", struct.pack("<II", len(literal), len(packed)) + literal))
    repeated = bytes([3]) + bytes(4) + bytes([0x20 | 0xC0, 11, 3])  # 4 literal zeros, then 20 more from 4 back
    write("pcd", "compressed_repeats", pcd("binary_compressed", struct.pack("<II", len(repeated), 24) + repeated))
    write("pcd", "labelled", pcd("ascii", b"1 2 3 255 7\n4 5 6 1 10\n", "x y z rgb label", "4 4 8 4 2", "F F F F U"))
    write("pcd", "lying_width", pcd("binary", packed, width=100000000))
    write("pcd", "lying_compressed", pcd("binary_compressed", struct.pack("<II", 8, 0xFFFFFFF0) + bytes(8),
                                         width=65535, height=1500))


def ply(kind, data, count=2, more=""):
    return (f"ply\nformat {kind} 1.0\nelement vertex {count}\nproperty float x\nproperty double y\nproperty float z\n"
            f"property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uint label\n{more}end_header\n"
            ).encode() + data


def ply_seeds():
    camera = ("element camera 1\nproperty float view_px\nproperty float view_py\nproperty float view_pz\n"
              "property int viewportx\nproperty int viewporty\n")
    write("ply", "ascii_camera", ply("ascii", b"1 2 3 4 5 6 7\nnan -inf 1e30 1 2 3 4\n0 0 1 1 2\n", more=camera))
    for kind, order in (("binary_little_endian", "<"), ("binary_big_endian", ">")):
        row = struct.pack(order + "fdfBBBI", 1, 2, 3, 4, 5, 6, 7)
        write("ply", kind, ply(kind, row * 2))
        write("ply", f"wrong_end_{kind}", ply("binary_big_endian" if order == "<" else "binary_little_endian", row * 2))
    write("ply", "faces", b"ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
          b"element vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2\n1 2 3\n")
    write("ply", "lying_list", b"ply\nformat binary_little_endian 1.0\nelement face 100000000\n"
          b"property list uint double v\nend_header\n" + b"\xff" * 40)
    write("ply", "lying_count", ply("binary_little_endian", bytes(31), count=100000000))


def log_event(number, channel, data, channel_bytes=None, data_bytes=None):
    sizes = (len(channel) if channel_bytes is None else channel_bytes, len(data) if data_bytes is None else data_bytes)
    return struct.pack(">Iqqii", 0xEDA1DA01, number, 1700000000000000 + number, *sizes) + channel + data


def log_seeds():
    good = log_event(0, b"GRASPD_CLOUD", b"abc") + log_event(1, b"S", b"")
    table = [(2, b"number", struct.pack("<qq", 7, -1)), (6, b"text", struct.pack("<I", 2) + b"ab" + struct.pack("<I", 0))]
    write("parquet", "plain", parquet(table, 0))
    write("parquet", "zstd", parquet(table, 6))
    write("event_log", "two_events", good)
    write("event_log", "cut_short", good[:-1] + b"")
    write("event_log", "damaged_between", log_event(0, b"A", b"x") + b"\xed\xa1\xda\x01noise" + log_event(1, b"B", b"y"))
    for name, sizes in (("lying_data", (1, 0x7FFFFFFF)), ("negative_data", (1, -1)), ("negative_channel", (-1, 1)),
                        ("long_channel", (256, 0)), ("no_channel", (0, 1))):
        write("event_log", name, log_event(0, b"A", b"x", *sizes) + log_event(1, b"B", b"y"))


def seal_seeds():
    for name, payload, size in (("empty", b"", 0), ("payload", b"payload", 7), ("lying_size", b"x", 0x7FFFFFFF),
                                ("negative_size", b"x", -1)):
        write("sealed", name, struct.pack(">qqqqi", 1, 2, 3, 1700000000000000, size) + payload + bytes(32))
    write("sealed", "truncated", struct.pack(">qqqqi", 1, 2, 3, 4, 0) + bytes(31))
    write("seal_keys", "one", "# of the arm\n" + "0123456789abcdef" * 4 + "\n")
    write("seal_keys", "two", "ab" * 32 + "  # old\r\n\n" + "CD" * 32)
    write("seal_keys", "short", "ab" * 31)


def segmentation_seeds():
    reason = struct.pack(">i", 5) + b"palm\0"
    segment = struct.pack(">iii", 0, 0, 2) + struct.pack(">9d", *range(9)) + struct.pack(">ii", 3, 0) + reason
    segment += struct.pack(">i", 1) + reason + struct.pack(">q", 3)
    points = struct.pack("<5H", 0, 1, 65535, 0, 1) + struct.pack("<5H", 9, 8, 7, 65535, 2)
    head = struct.pack(">qq", 1, 2) + 2 * (struct.pack(">i", 2) + b"f\0") + struct.pack(">qddddd", 3, 0.003, 1, 2, 3, 1e-5)
    for name, count, size in (("two_points", 2, 20), ("lying_count", 0x7FFFFFFF, 20), ("lying_size", 2, -20)):
        tail = struct.pack(">4d", 0, 0, 1, 0.5) + struct.pack(">i", 1) + segment
        write("segmentation", name, head + struct.pack(">ii", count, size) + points + tail)
    write("segmentation", "no_such_segment", head + struct.pack(">ii", 2, 20) + points + struct.pack(">4di", 0, 0, 0, 0, 0))
    for name, seconds in (("two_seconds", 2.0), ("for_ever", float("inf")), ("no_number", float("nan"))):
        write("segmentation_request", name, struct.pack(">qi", 1, 2) + b"C\0" + struct.pack(">d", seconds))


def main():
    for seeds in (detect_seeds, foreign_seeds, image_seeds, config_seeds, pcd_seeds, ply_seeds, log_seeds, seal_seeds, segmentation_seeds):
        seeds()


if __name__ == "__main__":
    main()
