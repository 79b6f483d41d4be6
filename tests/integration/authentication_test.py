# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""With a key file only signed messages are taken, each once: everything else is refused and counted by its reason."""
import signal

from harness import CLOUDS, HANDLES, TYPES, run_tests
from sealing import Sealer, now_us
from traffic import MOST_AT_ONCE, TrafficTest

LIST = TYPES["handle_list_t"].constants
GOOD = {LIST["OK"], LIST["NO_HANDLES"]}
CONFIG = """
lcm: {{control_channel: CONTROL}}
authentication: {{key_file: "{key_file}", max_age_s: 60}}
sources:
  - {{name: camera, channel: GRASPD_CLOUD, policy: all, queue_length: 200}}
  - {{name: more, channel: "MORE_.*", policy: all, handles_channel: HANDLES_OF_MORE}}
"""
OLD_S = 3600


class Authentication(TrafficTest):
    def setUp(self):
        super().setUp()
        self.key_file = self.folder / "key"
        self.run_program("graspd-keygen", self.key_file)
        self.sealer = Sealer.from_file(self.key_file)

    def start_with_key(self):
        self.cloud = self.record_frames(1, width=160)[0]
        self.message = self.with_seq(self.cloud, 1)
        self.bus = self.open_bus()
        return self.start_daemon(self.bus, self.write_config(CONFIG.format(key_file=self.key_file)))

    def send(self, messages):
        """Their answers, in their order."""
        before = len(self.bus.on(HANDLES))
        for message in messages:
            self.publish_paced(self.bus, CLOUDS, message)
        return self.await_answers(self.bus, before + len(messages))[before:]

    def assert_counted(self, **reasons):
        received = sum(reasons.values())
        status = self.await_status(self.bus, lambda s: s.sources and s.sources[0].refused == received,
                                   "all refusals in the status")
        self.assertEqual({r.reason: r.count for r in status.sources[0].refusals}, reasons)

    def test_valid_messages_are_served(self):
        self.start_with_key()
        answers = self.send([self.sealer.seal(CLOUDS, self.with_seq(self.cloud, n)) for n in range(3)])
        self.assertEqual([a.seq for a in answers], [0, 1, 2])
        self.assertTrue({a.status for a in answers} <= GOOD)
        self.assert_counted()

    def test_everything_else_is_refused_and_counted(self):
        daemon = self.start_with_key()
        good = self.sealer.seal(CLOUDS, self.message)
        changed = bytearray(good)
        changed[len(good) // 2] ^= 1
        stranger = Sealer(bytes(32))
        claims_our_key = stranger.seal(CLOUDS, self.message, key_id=self.sealer.key_id)
        cases = [("unsigned", self.message), ("unsigned", b""), ("forged", bytes(changed)),
                 ("forged", good[:-1] + bytes([good[-1] ^ 1])), ("forged", stranger.seal(CLOUDS, self.message)),
                 ("forged", claims_our_key), ("forged", self.sealer.seal("OTHER_CHANNEL", self.message)),
                 ("truncated", good[:-1]), ("truncated", good[:60]), ("trailing_bytes", good + b"\0"),
                 ("stale", self.sealer.seal(CLOUDS, self.message, utime=now_us() - OLD_S * 1_000_000)),
                 ("stale", self.sealer.seal(CLOUDS, self.message, utime=now_us() + OLD_S * 1_000_000))]
        answers = self.send([data for _, data in cases] + [good, good])
        for (reason, _), answer in zip(cases, answers):
            self.assertEqual(answer.status, LIST["REFUSED"], reason)
            self.assertEqual(answer.seq, -1, f"{reason}: nothing of a stranger's message is believed")
        self.assertIn(answers[-2].status, GOOD, answers[-2].status_text)
        self.assertEqual(answers[-1].status, LIST["REFUSED"], "the same message again")
        counts = {reason: sum(r == reason for r, _ in cases) for reason, _ in cases}
        self.assert_counted(**counts, replayed=1)
        self.assertIsNone(daemon.process.poll(), daemon.err)

    def test_what_is_inside_a_seal_is_checked_like_any_other(self):
        self.start_with_key()
        answers = self.send([self.sealer.seal(CLOUDS, data) for data in (b"", b"nonsense", self.message[:-5])])
        self.assertEqual({a.status for a in answers}, {LIST["REFUSED"]})
        nested = self.sealer.seal(CLOUDS, self.sealer.seal(CLOUDS, self.message))
        self.assertEqual(self.send([nested])[0].status, LIST["REFUSED"])
        self.assert_counted(truncated=2, unknown_type=2)

    def test_strangers_do_not_use_up_channels(self):
        self.start_with_key()
        for number in range(3 * MOST_AT_ONCE):
            self.publish_paced(self.bus, f"MORE_{number}", self.message)
            if (number + 1) % MOST_AT_ONCE == 0:
                status = self.await_status(self.bus, lambda s, n=number: s.ignored == n + 1, "the strangers' messages, ignored")
        self.assertEqual([s.channel for s in status.sources], [CLOUDS, "MORE_.*"])
        self.publish_paced(self.bus, "MORE_1", self.sealer.seal("MORE_1", self.message))
        answer = self.await_answers(self.bus, 1, channel="HANDLES_OF_MORE")[0]
        self.assertIn(answer.status, GOOD)

    def test_the_programs_sign(self):
        self.start_with_key()
        frames = self.folder / "frames"
        self.run_program("graspd-publish", "--key", self.key_file, "--rate", 5, "--count", 2, "--loop", frames)
        self.run_program("graspd-simulate", "--key", self.key_file, "--rate", 5, "--frames", 2, "--width", 160,
                         "--type", "depth")
        self.assertTrue({a.status for a in self.await_answers(self.bus, 4)} <= GOOD)
        self.assert_counted()

    def control(self, number, text):
        return TYPES["control_t"].encode(utime=0, id=number, command=TYPES["control_t"].constants["SET"], text=text)

    def test_control_messages_must_be_signed_too(self):
        self.start_with_key()
        text = "limits: {max_points: 1000}"
        replayed = self.sealer.seal("CONTROL", self.control(1, text))
        self.bus.publish("CONTROL", replayed)
        self.await_status(self.bus, lambda s: s.config_revision == 2, "the signed one, taken")
        for bad in (self.control(2, text), replayed, self.sealer.seal(CLOUDS, self.control(3, text))):
            self.bus.messages.clear()
            self.bus.publish("CONTROL", bad)
            status = self.await_status(self.bus, lambda s: "sealed_t" in s.config_error, "the refusal in the status")
            self.assertEqual((status.config_revision, status.control_id), (2, 1))
            self.bus.publish("CONTROL", self.sealer.seal("CONTROL", self.control(1, text)))  # known: nothing to do
            self.bus.publish("CONTROL", self.sealer.seal("CONTROL", b"nonsense"))
            self.await_status(self.bus, lambda s: "no valid control_t" in s.config_error, "another error")

    def test_keys_change_at_a_reload(self):
        daemon = self.start_with_key()
        self.assertIn(self.send([self.sealer.seal(CLOUDS, self.message)])[0].status, GOOD)
        old, new = self.sealer, Sealer(bytes(range(32)))
        both = new.key.hex() + "\n" + old.key.hex() + "\n"
        for text, takes_old in ((both, True), (new.key.hex(), False)):
            self.key_file.write_text(text, encoding="ascii")
            revision = self.await_status(self.bus, lambda s: True, "a status").config_revision
            daemon.process.send_signal(signal.SIGHUP)
            self.await_status(self.bus, lambda s, r=revision: s.config_revision == r + 1, "the reload")
            answers = self.send([new.seal(CLOUDS, self.message), old.seal(CLOUDS, self.message)])
            self.assertIn(answers[0].status, GOOD)
            self.assertEqual(answers[1].status in GOOD, takes_old)
        self.key_file.chmod(0o666)
        daemon.process.send_signal(signal.SIGHUP)
        self.await_status(self.bus, lambda s: "others may read" in s.config_error, "the refusal in the status")
        self.assertIn(self.send([new.seal(CLOUDS, self.message)])[0].status, GOOD)

    def test_keys_that_cannot_be_used_end_at_once(self):
        config = self.write_config(CONFIG.format(key_file=self.key_file))
        self.key_file.chmod(0o644)
        daemon = self.start("graspd", "--config", config)
        self.assertNotEqual(daemon.wait(), 0)
        self.assertIn("others may read or change it", daemon.err)
        self.run_program("graspd-simulate", "--key", self.key_file, "--frames", 1, code=1)
        self.run_program("graspd-keygen", self.key_file, code=1)


if __name__ == "__main__":
    run_tests()
