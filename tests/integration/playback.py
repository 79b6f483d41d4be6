# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Publishes the files of a folder, records the answers as CSV and holds them against graspd-detect."""
import csv
import pathlib
import signal

from harness import CLOUDS, HANDLES, TYPES, GraspdTest, wait_until

CONFIG = """
sources:
  - name: camera
    channel: GRASPD_CLOUD
    policy: all
    queue_length: 100
"""
# What a handle is; the rest of a row tells when and on which channel it came.
HANDLE_COLUMNS = ["px", "py", "pz", "qw", "qx", "qy", "qz", "width", "score"]


def largest_receive_buffer():
    """The kernel's limit [bytes]; None where this network namespace does not show it."""
    path = pathlib.Path("/proc/sys/net/core/rmem_max")
    return int(path.read_text(encoding="ascii")) if path.exists() else None


def handles_by_frame(text):
    """frame -> its handles in order, each as the strings of the CSV."""
    frames = {}
    for row in csv.DictReader(text.splitlines()):
        handles = frames.setdefault(row["frame"], [])
        if row["px"]:
            handles.append(tuple(row[column] for column in HANDLE_COLUMNS))
    return frames


class PlaybackTest(GraspdTest):
    def play_and_compare(self, folder, kind):
        count = len(list(folder.glob("*.pcd")))
        expected = self.run_program("graspd-detect", "--type", kind, folder)
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(CONFIG))
        listener = self.start_listening("graspd-listen", "--format", "csv", "--channel", HANDLES)
        self.run_program("graspd-publish", "--type", kind, "--rate", 10, folder)
        answers = self.await_answers(bus, count)

        self.assertEqual([a.seq for a in answers], sorted(a.seq for a in answers))
        self.assertEqual(len(bus.on(CLOUDS)), count)
        final = self.await_status(bus, lambda s: s.sources and s.sources[0].received == count and
                                  s.sources[0].pending == 0, "all frames in the status")
        self.assertEqual((final.sources[0].processed, final.sources[0].lost), (count, 0))

        wait_until(lambda: len(handles_by_frame("\n".join(listener.lines()))) == count, "the listener's last frame")
        self.assertEqual(listener.stop(signal.SIGINT)[0], 0, listener.err)
        got, want = handles_by_frame(listener.out), handles_by_frame(expected.out)
        self.assertEqual(list(got), list(want))
        for frame, handles in want.items():
            self.assertEqual(got[frame], handles, frame)
        self.assertEqual(sum(map(len, got.values())), sum(len(a.handles) for a in answers))
        self.assertTrue(any(got.values()), "not one handle in all the frames")
        self.assertEqual({a.status for a in answers} -
                         {TYPES["handle_list_t"].constants[s] for s in ("OK", "NO_HANDLES")}, set())
