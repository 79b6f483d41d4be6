# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""How a robot's owner runs the daemon: reload, control messages, systemd's protocol, the status programs."""
import json
import signal
import socket
import types

from harness import CLOUDS, PATIENCE_S, TYPES, run_tests
from traffic import TrafficTest

CONTROL = "GRASPD_CONTROL"
CONFIG = """
lcm: {{control_channel: GRASPD_CONTROL}}
detect: {{downsample: {{leaf_size_m: {leaf}}}}}
sources: [{{name: camera, channel: GRASPD_CLOUD, policy: all}}]
"""
COMMANDS = TYPES["control_t"].constants


class Operation(TrafficTest):
    def setUp(self):
        super().setUp()
        self.frame = self.record_frames(1, width=160)[0]
        self.seq = 0

    def answer(self, bus):
        """To one frame."""
        self.seq += 1
        self.publish_paced(bus, CLOUDS, self.with_seq(self.frame, self.seq))
        return self.await_answers(bus, self.seq)[-1]

    def control(self, bus, number, command, text=""):
        bus.publish(CONTROL, TYPES["control_t"].encode(utime=0, id=number, command=COMMANDS[command], text=text))
        return self.await_status(bus, lambda s: s.control_id == number, f"the answer to control {number}")

    def test_sighup_reloads_or_keeps(self):
        bus = self.open_bus()
        daemon = self.start_daemon(bus, self.write_config(CONFIG.format(leaf=0.003)))
        self.assertAlmostEqual(self.answer(bus).voxel_size, 0.003)
        self.write_config(CONFIG.format(leaf=0.004))
        daemon.process.send_signal(signal.SIGHUP)
        self.await_status(bus, lambda s: s.config_revision == 2, "the new configuration")
        answer = self.answer(bus)
        self.assertAlmostEqual(answer.voxel_size, 0.004)
        self.assertEqual(answer.config_revision, 2)
        for bad, reason in ((CONFIG.format(leaf=4), "leaf_size_m"), ("{", "not YAML"), ("nonsense: 1", "unknown key")):
            self.write_config(bad)
            daemon.process.send_signal(signal.SIGHUP)
            status = self.await_status(bus, lambda s, r=reason: r in s.config_error, "the reason")
            self.assertEqual(status.config_revision, 2)
            self.assertAlmostEqual(self.answer(bus).voxel_size, 0.004)
        (self.folder / "graspd.yaml").unlink()
        daemon.process.send_signal(signal.SIGHUP)
        status = self.await_status(bus, lambda s: "no such file" in s.config_error, "the reason")
        self.assertIn("config_refused", [e.event for e in status.errors])
        self.assertEqual(daemon.stop()[0], 0)

    def test_control_messages(self):
        bus = self.open_bus()
        daemon = self.start_daemon(bus, self.write_config(CONFIG.format(leaf=0.003)))
        text = "detect: {smoothness: {theta_low_deg: 5, edge_share: 0.25}, downsample: {leaf_size_m: 0.004}}"
        status = self.control(bus, 1, "SET", text)
        self.assertEqual((status.config_error, status.config_revision), ("", 2))
        self.assertIn("theta_low_deg: 5", status.overrides)
        self.assertAlmostEqual(self.answer(bus).voxel_size, 0.004)
        self.control(bus, 2, "SET", "sources: [{name: camera, gripper: robotiq_2f_85}]")
        self.assertEqual(self.answer(bus).gripper.name, "robotiq_2f_85")
        status = self.control(bus, 3, "SET", "detect: {downsample: {leaf_size_m: 9}}")
        self.assertIn("leaf_size_m: out of range", status.config_error)
        self.assertEqual(status.config_revision, 3)
        self.control(bus, 4, "UNDO")
        self.assertEqual(self.answer(bus).gripper.name, "paper_80mm")
        self.write_config(CONFIG.format(leaf=0.0035))
        self.control(bus, 5, "RELOAD")
        self.assertAlmostEqual(self.answer(bus).voxel_size, 0.004, msg="what was SET stays on top")
        self.control(bus, 6, "RESET")
        self.assertAlmostEqual(self.answer(bus).voxel_size, 0.0035)
        for hostile in (b"", b"\0" * 7, TYPES["control_t"].fingerprint, TYPES["control_t"].fingerprint + b"\xff" * 40):
            bus.publish(CONTROL, hostile)
        self.assertEqual(self.control(bus, 7, "RELOAD").config_error, "")
        self.assertIsNone(daemon.process.poll())

    def test_degradation_and_deadline_are_seen_in_answers_and_status(self):
        bus = self.open_bus()
        config = """
sources:
  - {name: camera, channel: GRASPD_CLOUD, policy: all,
     degrade: {voxel_m: 0.006, above_ms: 1, below_ms: 0.5}}
  - {name: hurried, channel: HURRIED, handles_channel: HURRIED_HANDLES, policy: all, queue_length: 100,
     deadline_ms: 1}
"""
        self.start_daemon(bus, self.write_config(config))
        while self.seq < 12:
            answer = self.answer(bus)
        self.assertEqual(answer.degraded, 1)
        self.assertAlmostEqual(answer.voxel_size, 0.006)
        status = self.await_status(bus, lambda s: s.sources[0].degraded == 1, "a status that tells")
        self.assertGreater(status.sources[0].coarse, 0)
        for seq in range(20):
            self.publish_paced(bus, "HURRIED", self.with_seq(self.frame, seq))
        answers = self.await_answers(bus, 20, "HURRIED_HANDLES")
        self.assertEqual([a.seq for a in answers], list(range(20)))
        late = [a for a in answers if a.status == TYPES["handle_list_t"].constants["OVERLOADED"]]
        self.assertGreater(len(late), 0)
        self.assertTrue(all("deadline_ms" in a.status_text for a in late))
        status = self.await_status(bus, lambda s: s.sources[1].received == 20 and s.sources[1].pending == 0,
                                   "a status that counts them")
        self.assertEqual({d.reason: d.count for d in status.sources[1].drops}, {"deadline": len(late)})

    def test_systemd(self):
        path = str(self.folder / "notify")
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as systemd:
            systemd.bind(path)
            systemd.settimeout(PATIENCE_S)
            bus = self.open_bus()
            config = self.write_config(CONFIG.format(leaf=0.003))
            told = []

            def await_message(start):
                while not any(m.startswith(start) for m in told):
                    told.append(systemd.recv(4096).decode())
                found = [m for m in told if m.startswith(start)][0]
                del told[:told.index(found) + 1]
                return found

            daemon = self.start("graspd", "--config", config,
                                environment={"NOTIFY_SOCKET": path, "WATCHDOG_USEC": "300000"})
            await_message("READY=1")
            self.assertIn("1 sources", await_message("STATUS="))
            for _ in range(3):
                await_message("WATCHDOG=1")
            self.answer(bus)
            self.write_config("bad")
            daemon.process.send_signal(signal.SIGHUP)
            self.assertIn("MONOTONIC_USEC=", await_message("RELOADING=1"))
            await_message("READY=1")
            daemon.process.send_signal(signal.SIGTERM)
            await_message("STOPPING=1")
            self.assertEqual(daemon.wait(), 0)

    def test_status_programs(self):
        bus = self.open_bus()
        daemon = self.start_daemon(bus, self.write_config(CONFIG.format(leaf=0.003)))
        self.answer(bus)
        self.publish_paced(bus, CLOUDS, b"junk")
        self.await_answers(bus, 2)
        as_json = json.loads(self.run_program("graspd-status", "--once", "--format", "json", "--timeout", PATIENCE_S).out)
        self.assertEqual(as_json["pid"], daemon.process.pid)
        self.assertEqual(as_json["sources"][0]["refused"], 1)
        self.assertGreater(as_json["num_descriptors"], 0)
        self.assertEqual([e["event"] for e in as_json["errors"]], ["frame_refused"])
        text = self.run_program("graspd-status", "--once", "--timeout", PATIENCE_S).out
        self.assertIn("camera", text)
        self.assertIn("frame_refused", text)

    def test_prometheus(self):
        bus = self.open_bus()
        daemon = self.start_daemon(bus, self.write_config(CONFIG.format(leaf=0.003)))
        self.answer(bus)
        self.await_status(bus, lambda s: s.sources[0].processed == 1, "a status that counts the frame")
        path = self.folder / "graspd.prom"
        path.write_text("old\n", encoding="ascii")
        self.run_program("graspd-status", "--once", "--prometheus", path, "--timeout", PATIENCE_S)
        self.assertEqual(sorted(p.name for p in self.folder.glob("*.prom*")), ["graspd.prom"])
        metrics = self.parse_metrics(path.read_text(encoding="utf-8"))
        self.assertEqual(metrics['graspd_frames_received_total{source="camera",channel="GRASPD_CLOUD"}'], 1)
        self.assertEqual(metrics['graspd_frames_processed_total{source="camera",channel="GRASPD_CLOUD"}'], 1)
        self.assertGreater(metrics["graspd_resident_memory_bytes"], 1e6)
        self.assertEqual(metrics["graspd_up"], 1)
        # Watched by one who reads as often as possible: never a part of a file, never none.
        program = self.start("graspd-status", "--prometheus", path, "--count", 3)
        while program.process.poll() is None:
            self.parse_metrics(path.read_text(encoding="utf-8"))
        self.assertEqual(program.process.returncode, 0)
        daemon.stop()
        self.run_program("graspd-status", "--once", "--prometheus", path, "--timeout", 1.5, code=1)
        self.assertEqual(self.parse_metrics(path.read_text(encoding="utf-8"))["graspd_up"], 0)

    def parse_metrics(self, text):
        """{name and labels: value}, after a look at the form: HELP and TYPE before each family, once."""
        self.assertTrue(text.endswith("\n"))
        values, families, current = {}, set(), types.SimpleNamespace(name=None, kind=None)
        for line in text.splitlines():
            words = line.split(" ")
            if words[:2] == ["#", "HELP"]:
                self.assertNotIn(words[2], families)
                families.add(words[2])
                current.name = words[2]
            elif words[:2] == ["#", "TYPE"]:
                self.assertEqual(words[2], current.name)
                current.kind = words[3]
                self.assertEqual(current.kind == "counter", current.name.endswith("_total"))
            else:
                key, value = line.rsplit(" ", 1)
                self.assertEqual(key.split("{")[0], current.name)
                self.assertNotIn(key, values)
                values[key] = float(value)
        return values


if __name__ == "__main__":
    run_tests()
