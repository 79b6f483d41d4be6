# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Holds the tables of a log, read by pyarrow, DuckDB and pandas, against the log itself.

    check_tables.py LOG TABLE.parquet FRAMES
"""
import pathlib
import struct
import sys

import duckdb
import pandas
import pyarrow.parquet

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "integration"))
from event_logs import read_log  # noqa: E402
from lcm_types import load_types  # noqa: E402


def as_float(value):
    return struct.unpack("f", struct.pack("f", value))[0]


def expected(log):
    lists = load_types()["handle_list_t"]
    frames = [(event, lists.decode(event.data)) for event in read_log(pathlib.Path(log))]
    handles = [(number, message.utime, message.seq, message.source_channel, h.id, h.segment_id,
                *(as_float(x) for x in (*h.position, *h.orientation, *h.rpy, *h.approach, *h.closing_axis, *h.major_axis,
                                        h.width, *h.gap, *h.observed_free)), h.num_points, as_float(h.score))
               for number, (_, message) in enumerate(frames) for h in message.handles]
    return frames, handles


def main(log, handles_file, count):
    frames_file = handles_file.removesuffix(".parquet") + ".frames.parquet"
    frames, handles = expected(log)
    assert len(frames) == int(count), len(frames)
    for name, rows in (
            ("pyarrow", [tuple(r.values()) for r in pyarrow.parquet.read_table(handles_file).to_pylist()]),
            ("duckdb", duckdb.sql(f"SELECT * FROM '{handles_file}'").fetchall()),
            ("pandas", list(pandas.read_parquet(handles_file).itertuples(index=False, name=None)))):
        assert rows == handles, f"{name}: the handles are not the log's"
    names = {v: k for k, v in load_types()["handle_list_t"].constants.items()}
    wanted = [(i, e.utime, m.utime, m.seq, e.channel, m.frame_name, m.gripper.name, names[m.status], m.status_text,
               m.voxel_size, m.points_in, m.num_candidates, len(m.handles), m.latency)
              for i, (e, m) in enumerate(frames)]
    columns = ("frame, recv_utime, utime, seq, handles_channel, frame_name, gripper, status, status_text, voxel_size, "
               "points_in, num_candidates, num_handles, latency")
    assert duckdb.sql(f"SELECT {columns} FROM '{frames_file}'").fetchall() == wanted, "the frames are not the log's"
    table = pyarrow.parquet.read_table(frames_file, columns=[c.strip() for c in columns.split(",")])
    assert [tuple(r.values()) for r in table.to_pylist()] == wanted
    print(f"{len(frames)} frames, {len(handles)} handles: the same by pyarrow, DuckDB and pandas")


if __name__ == "__main__":
    main(*sys.argv[1:])
