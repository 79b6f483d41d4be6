# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""The demo's summary on answers and truth that can be counted by hand."""
import contextlib
import io
import json
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "client"))
import demo_summary  # noqa: E402  (after the path to it)


def answer(seq, status="OK", positions=(), latency=0.01):
    return {"seq": seq, "status": status, "points_in": 10_000, "latency": latency,
            "handles": [{"position": list(p)} for p in positions]}


def frame(seq, *objects):
    return {"seq": seq, "objects": [{"label": label, "pixels": pixels, "points": [list(p) for p in points]}
                                    for label, pixels, points in objects]}


class Summary(unittest.TestCase):
    def rows(self, answers, frames):
        return dict(demo_summary.summary(answers, {f["seq"]: f for f in frames}))

    def test_objects_with_a_handle(self):
        two = (20, 500, [(0, 0, 1)]), (30, 500, [(0.1, 0, 1)])
        rows = self.rows([answer(0, positions=[(0.001, 0, 1), (0.002, 0, 1)]), answer(1, "NO_HANDLES")],
                         [frame(0, *two), frame(1, *two)])
        self.assertEqual(rows["objects with a handle"], "1 of 4 (25 %)")
        self.assertEqual(rows["handles on an object"], "2 of 2")
        self.assertEqual(rows["handles per frame"], "1.0")

    def test_a_handle_beside_everything_is_on_no_object(self):
        rows = self.rows([answer(0, positions=[(0.05, 0, 1)])], [frame(0, (20, 500, [(0, 0, 1)]))])
        self.assertEqual(rows["objects with a handle"], "0 of 1 (0 %)")
        self.assertEqual(rows["handles on an object"], "0 of 1")

    def test_a_handle_belongs_to_the_nearest_object_alone(self):
        objects = (20, 500, [(0, 0, 1)]), (30, 500, [(0.015, 0, 1)])
        rows = self.rows([answer(0, positions=[(0.012, 0, 1)])], [frame(0, *objects)])
        self.assertEqual(rows["objects with a handle"], "1 of 2 (50 %)")
        self.assertEqual(demo_summary.object_of((0.012, 0, 1), frame(0, *objects)["objects"]), 30)

    def test_objects_that_are_hardly_seen_are_not_asked_for(self):
        rows = self.rows([answer(0)], [frame(0, (20, 9, [(0, 0, 1)]), (30, 10, [(1, 0, 1)]))])
        self.assertEqual(rows["objects with a handle"], "0 of 1 (0 %)")

    def test_dropped_frames_count_as_answered_and_for_nothing_else(self):
        rows = self.rows([answer(0, "OVERLOADED", latency=9), answer(1, latency=0.02)], [frame(0), frame(1), frame(2)])
        self.assertEqual((rows["frames sent"], rows["answered"], rows["of these dropped for newer ones"]), (3, 2, 1))
        self.assertEqual(rows["latency, cloud to handles"], "p50 20.0 ms, p99 20.0 ms")

    def test_percentiles(self):
        values = list(range(1, 101))
        self.assertEqual([demo_summary.percentile(values, s) for s in (0, 0.5, 0.99, 1)], [1, 50, 99, 100])

    def test_exit_code_tells_lost_answers(self):
        with tempfile.TemporaryDirectory() as folder:
            handles, truth = (pathlib.Path(folder) / name for name in ("handles", "truth"))
            truth.write_text("".join(json.dumps(frame(s)) + "\n" for s in (0, 1)), encoding="utf-8")
            for count, code in ((2, 0), (1, 1), (0, 1)):
                lines = "".join(json.dumps(answer(s)) + "\n" for s in range(count))
                handles.write_text(lines + '{"seq": 7, "sta', encoding="utf-8")  # the last line is not complete
                with contextlib.redirect_stdout(io.StringIO()):
                    self.assertEqual(demo_summary.main([str(handles), str(truth)]), code)


if __name__ == "__main__":
    unittest.main()
