#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""What tests/cross_language/run has built, against each other and the real daemon: golden messages, listeners, publishers, and the
ten lines of the Python package's README."""
import base64
import json
import os
import pathlib
import re
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE.parent / "integration"))
from event_logs import write_messages  # noqa: E402
from foreign_messages import Frame, own_message  # noqa: E402
from harness import CLOUDS, HANDLES, TYPES, GraspdTest, run_tests, wait_until  # noqa: E402

OUT = pathlib.Path(os.environ.get("GRASPD_LANGUAGES", ROOT / "build/languages"))
EXAMPLES, GOLDEN = ROOT / "client/examples", HERE / "golden"
JAVA = ["java", "-cp", f"{OUT}/java:{OUT}/java/graspd-types.jar:/usr/share/java/lcm.jar"]
PYTHON, LUA = [OUT / "python/bin/python"], ["lua5.2"]
LUA_PATH = {"LUA_PATH": f"{OUT}/lua/?.lua;{OUT}/lua/?/init.lua"}
TOP = sorted(p.stem for p in GOLDEN.glob("*_t.bin"))
# Language -> how its listener, its publisher and its golden program are started. JavaScript does not decode: it gets JSON.
LANGUAGES = {
    "c": ([OUT / "c/listen"], [OUT / "c/publish"], [OUT / "c/golden"]),
    "cpp": ([OUT / "cpp/listen"], [OUT / "cpp/publish"], [OUT / "cpp/golden"]),
    "go": ([OUT / "go/listen"], [OUT / "go/publish"], [OUT / "go/golden"]),
    "javascript": (["node", OUT / "javascript/build/listen.js"], ["node", OUT / "javascript/build/publish.js"], None),
    "java": (JAVA + ["Listen"], JAVA + ["Publish"], JAVA + ["Golden"]),
    "lua": (LUA + [EXAMPLES / "lua/listen.lua"], LUA + [EXAMPLES / "lua/publish.lua"], LUA + [HERE / "golden.lua"]),
    "python": (PYTHON + [EXAMPLES / "python/listen.py"], PYTHON + [EXAMPLES / "python/publish.py"], PYTHON + [HERE / "golden.py"]),
}
COLUMNS = ["px", "py", "pz", "qw", "qx", "qy", "qz", "width", "score"]
CONFIG = "sources: [{name: camera, channel: GRASPD_CLOUD, policy: all, queue_length: 100}]\n"


def same(golden, got):
    """Equal values; bytes may be base64, as Go has them."""
    if isinstance(golden, dict):
        return isinstance(got, dict) and golden.keys() == got.keys() and all(same(v, got[k]) for k, v in golden.items())
    if isinstance(golden, list):
        if isinstance(got, str):
            got = list(base64.b64decode(got))
        return len(golden) == len(got) and all(map(same, golden, got))
    return golden == got


def csv_of(answer):
    """The lines that every listener prints for a handle list."""
    lines = []
    for h in answer.handles:
        numbers = [*h.position, *h.orientation, h.width, h.score]
        lines.append(",".join([answer.frame_name, *(f"{n:.6f}" for n in numbers)]))
    return lines


class Languages(GraspdTest):
    def start_bridge(self):
        """Its address with the token, for programs that speak no LCM."""
        bridge = self.start_listening("graspd-bridge", "--port", 0, "--cloud-channel", CLOUDS)
        return wait_until(lambda: bridge.lines(), "the bridge's address")[0]

    def start_foreign(self, command, *arguments, bridge=""):
        path = shutil.which(str(command[0]))
        self.assertIsNotNone(path, f"no {command[0]}: run tests/cross_language/run")
        return self.start(path, *command[1:], *arguments, environment={**LUA_PATH, "GRASPD_BRIDGE": bridge})

    def test_goldens(self):
        for language, (_, _, golden) in LANGUAGES.items():
            if golden is None:
                continue
            with self.subTest(language):
                out = self.folder / language
                out.mkdir()
                program = self.start_foreign(golden, GOLDEN, out, *(TOP if language == "lua" else []))
                self.assertEqual(program.wait(), 0, program.err)
                for name in TOP:
                    self.assertEqual((out / f"{name}.bin").read_bytes(), (GOLDEN / f"{name}.bin").read_bytes(), name)
                    want = json.loads((GOLDEN / f"{name}.json").read_text(encoding="utf-8"))
                    got = json.loads((out / f"{name}.json").read_text(encoding="utf-8"))
                    self.assertTrue(same(want, got), f"{language} {name}: {got}")

    def test_golden_cloud_of_javascript(self):
        """The one type that goes into the bridge as it is on the wire."""
        program = self.start_foreign(["node", HERE / "golden.mjs", OUT / "javascript/build", GOLDEN, self.folder])
        self.assertEqual(program.wait(), 0, program.err)
        self.assertEqual((self.folder / "point_cloud_t.bin").read_bytes(), (GOLDEN / "point_cloud_t.bin").read_bytes())

    def test_listeners(self):
        """All hear the same daemon answer the same log."""
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(CONFIG))
        bridge = self.start_bridge()
        listeners = {language: self.start_foreign(commands[0], bridge=bridge) for language, commands in LANGUAGES.items()}
        for language, listener in listeners.items():
            wait_until(lambda one=listener: one.lines() or one.process.poll() is not None, f"{language}'s first line")
            self.assertEqual(listener.lines(), ["frame," + ",".join(COLUMNS)], f"{language}: {listener.err}")
        probe = TYPES["handle_list_t"].decode((GOLDEN / "handle_list_t.bin").read_bytes())
        probe.frame_name = "probe"
        for language, listener in listeners.items():
            self.probe(bus, HANDLES, TYPES["handle_list_t"].encode(**vars(probe)),
                       lambda one=listener: "probe" in one.out, f"{language}'s listener to hear")
        bus.receive(0.2)
        bus.messages.clear()
        frames = [Frame.of_pcd(p) for p in sorted(self.simulate(3, "--sensor", "kinect").glob("*.pcd"))]
        log = self.folder / "clouds.log"
        write_messages(log, [(CLOUDS, own_message(frame)) for frame in frames], period_s=0.3)
        player = self.start(shutil.which("lcm-logplayer"), log)
        answers = self.await_answers(bus, len(frames))
        self.assertEqual(player.wait(), 0, player.err)
        want = [line for answer in answers for line in csv_of(answer)]
        self.assertGreater(len(want), 2)
        for language, listener in listeners.items():
            heard = lambda one=listener: [line for line in one.lines()[1:] if not line.startswith("probe")]  # noqa: E731
            wait_until(lambda: len(heard()) >= len(want), f"{language}'s last line")
            self.assertEqual(heard(), want, language)

    def test_publishers(self):
        """All send the same cloud, so all get the same handles."""
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(CONFIG))
        bridge = self.start_bridge()
        found = {}
        for language, (_, publish, _) in LANGUAGES.items():
            bus.messages.clear()
            program = self.start_foreign(publish, bridge=bridge)
            answer = self.await_answers(bus, 1)[0]
            self.assertEqual(program.wait(), 0, program.err)
            self.assertEqual((answer.frame_name, answer.utime, answer.points_in), (language, 1, 4800))
            found[language] = [line.split(",", 1)[1] for line in csv_of(answer)]
        self.assertGreater(len(found["python"]), 0)
        for language, lines in found.items():
            self.assertEqual(lines, found["python"], language)

    def test_ten_lines(self):
        """The first program of the Python package's README, as it stands there."""
        readme = (ROOT / "client/python/README.md").read_text(encoding="utf-8")
        program = re.search(r"```python\n(.*?)```", readme, re.DOTALL).group(1)
        self.assertLessEqual(len(program.splitlines()), 10)
        script = self.folder / "ten_lines.py"
        script.write_text(program, encoding="utf-8")
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(CONFIG))
        newcomer = self.start(PYTHON[0], "-u", script)
        cloud = own_message(Frame.of_pcd(next(iter(self.simulate(1, width=320).glob("*.pcd")))))
        self.probe(bus, CLOUDS, cloud, lambda: "]]" in newcomer.out or newcomer.process.poll() is not None, "a matrix")
        self.assertIsNone(newcomer.process.poll(), newcomer.err)
        bus.receive(0.2)
        best = bus.on(HANDLES, TYPES["handle_list_t"])[-1].handles[0]
        first = re.search(r"\[\[.*?\]\]", newcomer.out, re.DOTALL).group(0)
        rows = [[float(n) for n in row.split()] for row in re.sub(r"[\[\]]", "", first).splitlines()]
        for axis in range(3):
            self.assertAlmostEqual(rows[axis][3], best.position[axis], places=6)
            self.assertAlmostEqual(rows[axis][0], best.major_axis[axis], places=5)
            self.assertAlmostEqual(rows[axis][1], best.closing_axis[axis], places=5)
            self.assertAlmostEqual(rows[axis][2], best.approach[axis], places=5)

    def test_ask_and_pre_grasp(self):
        """The second one's steps, on the publishers' cloud."""
        script = self.folder / "ask.py"
        script.write_text(f"""import json, sys
import graspd, numpy
sys.argv = ["publish.py"]
exec(open({str(EXAMPLES / "python/publish.py")!r}).read().split("graspd.connect")[0])
answer = graspd.ask(graspd.points(cloud))
grasp = graspd.matrices(answer)[0]
print(json.dumps([answer.status, grasp.tolist(), graspd.pre_grasp(grasp, 0.1).tolist(),
                  graspd.tool_pose(grasp, answer.gripper).tolist(), answer.gripper.grasp_depth]))
""", encoding="utf-8")
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(CONFIG))
        program = self.start(PYTHON[0], script)
        self.assertEqual(program.wait(), 0, program.err)
        status, grasp, before, tool, depth = json.loads(program.out)
        self.assertEqual(status, 0)
        for axis in range(3):
            self.assertAlmostEqual(before[axis][3], grasp[axis][3] - 0.1 * grasp[axis][2], places=9)
            self.assertAlmostEqual(tool[axis][3], grasp[axis][3] + depth * grasp[axis][2], places=9)
            self.assertEqual(before[axis][:3], grasp[axis][:3])


if __name__ == "__main__":
    run_tests()
