# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Publishes the files of a folder, records the answers as CSV and holds them against graspd-detect."""
import csv
import math
import signal
from array import array
from types import SimpleNamespace

from harness import CLOUDS, HANDLES, TYPES, GraspdTest, wait_until

CONFIG = """
sources:
  - name: camera
    channel: GRASPD_CLOUD
    policy: all
    queue_length: 100
"""
PROBE = "probe"
# What a handle is; the rest of a row tells when and on which channel it came.
HANDLE_COLUMNS = ["px", "py", "pz", "qw", "qx", "qy", "qz", "width", "score"]


def handles_by_frame(text):
    """frame -> its handles in order, each as the strings of the CSV."""
    frames = {}
    for row in csv.DictReader(text.splitlines()):
        if row["frame"] == PROBE:
            continue
        handles = frames.setdefault(row["frame"], [])
        if row["px"]:
            handles.append(tuple(row[column] for column in HANDLE_COLUMNS))
    return frames


def empty_list(frame):
    """An answer without handles for a frame of that name, as a message."""
    gripper = SimpleNamespace(name="", aperture=0, finger_width=0, finger_thickness=0, finger_length=0, grasp_depth=0,
                              min_gap=0)
    return TYPES["handle_list_t"].encode(
        utime=0, seq=0, source_channel="", frame_name=frame, gripper=gripper, status=0, status_text="",
        config_revision=0, voxel_size=0, degraded=0, points_in=0,
        points_used=0, num_segments=0, num_candidates=0, num_candidate_failures=0, candidate_failures=[],
        num_segment_failures=0, segment_failures=[], num_stages=0, stages=[], latency=0, num_handles=0, handles=[])


def write_pcd(path, image):
    """The points of a depth_image_t as a binary PCD file, rounded to float32 as often as the contract has it."""
    scale = array("f", [image.depth_scale])[0]
    columns = array("f", [(u - image.cx) / image.fx for u in range(image.width)])
    rows = array("f", [(v - image.cy) / image.fy for v in range(image.height)])
    depths = array("H", image.data)
    z = array("f", [d * scale if d else math.nan for d in depths])
    points = array("f", bytes(12 * len(z)))
    points[0::3] = array("f", [c * d for v in range(image.height)
                               for c, d in zip(columns, z[v * image.width:(v + 1) * image.width])])
    points[1::3] = array("f", [rows[v] * d for v in range(image.height)
                               for d in z[v * image.width:(v + 1) * image.width]])
    points[2::3] = z
    header = ("VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
              f"WIDTH {image.width}\nHEIGHT {image.height}\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(z)}\nDATA binary\n")
    path.write_bytes(header.encode() + points.tobytes())


class PlaybackTest(GraspdTest):
    def play_and_compare(self, folder, kind):
        count = len(list(folder.glob("*.pcd")))
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(CONFIG))
        listener = self.start_listening("graspd-listen", "--format", "csv", "--empty-rows", "--channel", HANDLES)
        self.probe(bus, HANDLES, empty_list(PROBE), lambda: PROBE in listener.out, "the listener's first line")
        bus.receive(0.1)
        bus.messages.clear()
        publisher = self.start("graspd-publish", "--type", kind, "--rate", 10, folder)
        answers = self.await_answers(bus, count)
        self.assertEqual(publisher.wait(), 0, publisher.err)
        self.check_answers(bus, answers)

        wait_until(lambda: len(handles_by_frame("\n".join(listener.lines()))) == count, "the listener's last frame")
        self.assertEqual(listener.stop(signal.SIGINT)[0], 0, listener.err)
        got = handles_by_frame(listener.out)
        self.assertEqual(sum(map(len, got.values())), sum(len(a.handles) for a in answers))
        self.assertTrue(any(got.values()), "not one handle in all the frames")

        files = folder if kind == "cloud" else self.write_received_images(bus, count)
        detected = self.run_program("graspd-detect", "--format", "csv", "--empty-rows", files)
        want = handles_by_frame(detected.out)
        self.assertEqual(list(got), list(want))
        for frame, handles in want.items():
            self.assertEqual(got[frame], handles, frame)

    def check_answers(self, bus, answers):
        """One for each frame, in their order, none lost or dropped."""
        self.assertEqual([a.seq for a in answers], list(range(len(answers))))
        self.assertEqual({a.status for a in answers} -
                         {TYPES["handle_list_t"].constants[s] for s in ("OK", "NO_HANDLES")}, set())
        final = self.await_status(bus, lambda s: s.sources and s.sources[0].received == len(answers) and
                                  s.sources[0].pending == 0, "all frames in the status")
        self.assertEqual((final.sources[0].processed, final.sources[0].lost), (len(answers), 0))

    def write_received_images(self, bus, count):
        folder = self.folder / "received"
        folder.mkdir()
        images = bus.on(CLOUDS, TYPES["depth_image_t"])
        self.assertEqual(len(images), count)
        for image in images:
            write_pcd(folder / f"{image.frame_name}.pcd", image)
        return folder
