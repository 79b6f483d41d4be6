# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""graspd-meldis before the real Meldis: it draws what the daemon finds, and goes on doing so.

    VENV/bin/python tests/viewers/meldis_test.py       VENV: with the package drake; tests/packaging/run meldis makes one
"""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "integration"))
from harness import GraspdTest, run_tests, skip_all  # noqa: E402  pylint: disable=wrong-import-position

try:
    from drake import lcmt_viewer_draw, lcmt_viewer_link_data
    from pydrake.lcm import DrakeLcm
    from pydrake.visualization import Meldis
except ImportError as error:
    skip_all(f"the Python package drake: {error}")

FRAME = "/DRAKE_DRAW_FRAMES/GRASPD/handle_0"
CLOUD = "/POINT_CLOUD/GRASPD"
GRIPPER = "/DRAKE_VIEWER/0/graspd/best"


class MeldisDraws(GraspdTest):
    def serve(self, meldis, seconds):
        """As its program does; it ends by itself because no browser comes."""
        with self.assertRaises(SystemExit) as ended:
            meldis.serve_forever(idle_timeout=seconds)
        self.assertEqual(ended.exception.code, 1)  # what it says when nobody was there

    def test_frames_cloud_and_grippers(self):
        meldis = Meldis()
        bus = self.open_bus()
        self.start_daemon(bus)
        drawer = self.start_listening("graspd-meldis")
        for path in (FRAME, CLOUD, GRIPPER):
            self.assertFalse(meldis.meshcat.HasPath(path), path)
        self.start("graspd-simulate", "--width", 320, "--rate", 5, "--frames", 40)
        self.serve(meldis, 5)
        for path in (FRAME, CLOUD, GRIPPER):
            self.assertTrue(meldis.meshcat.HasPath(path), path)
        self.assertIsNone(drawer.process.poll())
        self.serve(meldis, 1)  # polls the scene that is there
        self.assertEqual(drawer.stop()[0], 0, drawer.err)

    def test_drakes_own_decoder_reads_frames_and_grippers(self):
        """The numbers in it are those of the handle list."""
        bus = self.open_bus()
        received = {}
        lcm = DrakeLcm()
        for channel, kind in (("DRAKE_DRAW_FRAMES_GRASPD", lcmt_viewer_draw), ("DRAKE_VIEWER_DEFORMABLE", lcmt_viewer_link_data)):
            lcm.Subscribe(channel, lambda data, c=channel, k=kind: received.setdefault(c, k.decode(data)))
        self.start_daemon(bus)
        self.start_listening("graspd-meldis")
        self.run_program("graspd-simulate", "--width", 160, "--rate", 2, "--frames", 3)
        for _ in range(200):
            lcm.HandleSubscriptions(10)
            if len(received) == 2:
                break
        lists = {answer.utime: answer for answer in self.await_answers(bus, 3)}
        frames, grippers = received["DRAKE_DRAW_FRAMES_GRASPD"], received["DRAKE_VIEWER_DEFORMABLE"]
        answer = lists[frames.timestamp]
        self.assertEqual(frames.num_links, min(5, answer.num_handles))
        self.assertGreater(frames.num_links, 0)
        for i, handle in enumerate(answer.handles[:5]):
            for ours, theirs in zip(handle.position, frames.position[i]):
                self.assertTrue(math.isclose(ours, theirs, abs_tol=1e-6))
            for ours, theirs in zip(handle.orientation, frames.quaternion[i]):
                self.assertTrue(math.isclose(ours, theirs, abs_tol=1e-6))
        self.assertEqual([geometry.string_data for geometry in grippers.geom], ["best", "others"])


if __name__ == "__main__":
    run_tests()
