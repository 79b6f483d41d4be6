# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""graspd-view --key: signed clouds are shown and what the page asks for is signed, live and from old logs; without it neither."""
import json
import signal

from event_logs import read_log, write_log
from harness import CLOUDS, GraspdTest, run_tests, wait_until
from sealing import Sealer
from web_socket import WebSocket

CONFIG = """
lcm: {{control_channel: GRASPD_CONTROL}}
authentication: {{key_file: "{key_file}", max_age_s: 60}}
sources:
  - {{name: camera, channel: GRASPD_CLOUD, policy: all, queue_length: 100}}
"""


class ViewKey(GraspdTest):
    def setUp(self):
        super().setUp()
        self.page = self.folder / "page"
        self.page.mkdir()
        (self.page / "index.html").write_text("<!doctype html>", encoding="ascii")
        self.key, self.other_key = self.folder / "key", self.folder / "other"
        for file in (self.key, self.other_key):
            self.run_program("graspd-keygen", file)
        self.config = self.write_config(CONFIG.format(key_file=self.key))

    def open_page(self, start, *options):
        view = start("graspd-view", "--port", 0, "--page", self.page, "--config", self.config, *options)
        url = wait_until(view.lines, "the page's address")[0]
        page = WebSocket(url.replace("http", "ws").replace("/#", "/socket?"))
        self.addCleanup(page.close)
        return view, page

    def start_live(self, *options):
        """A daemon that takes signed messages alone, and a page of its view; both have noticed each other."""
        self.bus = self.open_bus()
        self.daemon = self.start_daemon(self.bus, self.config)
        view, page = self.open_page(self.start_listening, *options)
        self.receive_text(page, "status")
        return view, page

    @staticmethod
    def receive_text(page, kind):
        """The next text of a type; whether a picture came before it."""
        shown = False
        while True:
            message = page.receive()
            if isinstance(message, bytes):
                shown = True
            elif json.loads(message)["type"] == kind:
                return json.loads(message), shown

    def send_signed_frames(self):
        self.run_program("graspd-simulate", "--key", self.key, "--rate", 5, "--frames", 3, "--width", 160, "--type", "depth")
        statuses = {answer.status for answer in self.await_answers(self.bus, 3)}
        self.assertLessEqual(statuses, {0, 4})  # OK, NO_HANDLES: the daemon took them

    def test_signed_clouds_are_shown_and_settings_go_out_signed(self):
        view, page = self.start_live("--key", self.key)
        self.send_signed_frames()
        wait_until(lambda: isinstance(page.receive(), bytes), "a frame on the page")
        page.send(json.dumps({"type": "set", "source": "camera", "theta_low_deg": 5}))
        self.await_status(self.bus, lambda s: s.config_revision == 2, "the setting, taken by the daemon")
        self.assertEqual(view.stop()[0], 0, view.err)

    def test_without_the_key_nothing_is_shown_or_set(self):
        for options in ([], ["--key", self.other_key]):
            with self.subTest(options):
                view, page = self.start_live(*options)
                self.send_signed_frames()
                for _ in range(2):
                    _, shown = self.receive_text(page, "status")
                    self.assertFalse(shown)
                page.send(json.dumps({"type": "set", "source": "camera", "theta_low_deg": 5}))
                status = self.await_status(self.bus, lambda s: s.config_error, "the refusal in the status")
                self.assertIn("sealed_t", status.config_error)
                self.assertEqual(status.config_revision, 1)
                for program in (view, self.daemon):
                    program.stop()

    def test_logs_of_any_age(self):
        plain, lists = self.folder / "plain.log", self.folder / "lists.log"
        self.run_program("graspd-simulate", "--log", plain, "--frames", 3, "--type", "depth", "--width", 160)
        self.run_program("graspd-replay", plain, "-o", lists)
        sealer = Sealer.from_file(self.key)
        events = []
        for cloud, answer in zip(read_log(plain), read_log(lists)):
            events.append(cloud._replace(data=Sealer(bytes(32)).seal(CLOUDS, cloud.data)))  # a stranger's
            events += [cloud._replace(data=sealer.seal(CLOUDS, cloud.data, utime=cloud.utime)), answer]
        log = self.folder / "sealed.log"
        write_log(log, [event._replace(number=number) for number, event in enumerate(events)])
        view, page = self.open_page(self.start, "--log", log, "--key", self.key)
        page.send(json.dumps({"type": "player", "playing": False, "seek_us": 0}))
        wait_until(lambda: isinstance(page.receive(), bytes), "a frame on the page")
        self.assertEqual(view.stop(signal.SIGINT)[0], 0, view.err)
        for options in (["--key", self.other_key], []):
            view = self.run_program("graspd-view", "--port", 0, "--page", self.page, "--log", log, *options, code=1)
            self.assertIn("signed messages: --key FILE opens them", view.err)

    def test_a_key_that_cannot_be_used_ends_at_once(self):
        self.key.chmod(0o644)
        view = self.run_program("graspd-view", "--port", 0, "--page", self.page, "--key", self.key, code=1)
        self.assertIn("others may read or change it", view.err)


if __name__ == "__main__":
    run_tests()
