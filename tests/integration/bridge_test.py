# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""graspd-bridge: what graspd-listen prints arrives over a WebSocket; settings and clouds go in with the token alone."""
import json
from array import array

from harness import CLOUDS, HANDLES, GraspdTest, run_tests, wait_until
from playback import PROBE, empty_list
from web_socket import Closed, WebSocket

CONFIG = """
lcm: {control_channel: GRASPD_CONTROL}
sources:
  - {name: camera, channel: GRASPD_CLOUD, policy: all, queue_length: 100}
  - {name: browser, channel: BROWSER_CLOUD, handles_channel: BROWSER_HANDLES}
"""


class Bridge(GraspdTest):
    def start_bridge(self, *arguments):
        bridge = self.start_listening("graspd-bridge", "--port", 0, "--cloud-channel", "BROWSER_CLOUD", "--handles", ".*_HANDLES",
                                      *arguments)
        url = wait_until(lambda: bridge.lines(), "the bridge's address")[0]
        self.assertRegex(url, r"^ws://127\.0\.0\.1:\d+/socket\?token=[0-9a-f]{32}$")
        return bridge, url

    def connect(self, url):
        client = WebSocket(url)
        self.addCleanup(client.close)
        hello = json.loads(client.receive())
        self.assertEqual(hello["type"], "hello")
        return client, hello["may_write"]

    @staticmethod
    def receive(client, kind, condition=lambda message: True):
        """The next message of a type that holds the condition."""
        while True:
            message = json.loads(client.receive())
            if message["type"] == kind and condition(message):
                return message

    def test_every_list_as_graspd_listen_prints_it(self):
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(CONFIG))
        listener = self.start_listening("graspd-listen", "--format", "json")
        self.probe(bus, HANDLES, empty_list(PROBE), listener.lines, "the listener's first line")
        bridge, url = self.start_bridge()
        client, may_write = self.connect(url.split("?")[0])
        self.assertFalse(may_write)
        self.run_program("graspd-simulate", "--width", 160, "--rate", 5, "--frames", 6)
        texts = []
        while len(texts) < 6:
            text = client.receive()
            if json.loads(text)["type"] == "handle_list":
                texts.append(text)

        def lines_of_frames():
            return [line for line in listener.lines() if PROBE not in line]
        lines = wait_until(lambda: lines_of_frames() if len(lines_of_frames()) >= 6 else None, "the listener's lines")
        self.assertEqual(texts, [f'{{"type":"handle_list","channel":"{HANDLES}","message":{line}}}' for line in lines])
        self.assertEqual(bridge.stop()[0], 0, bridge.err)

    def test_settings_need_the_token(self):
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(CONFIG))
        _, url = self.start_bridge()
        command = json.dumps({"type": "control", "command": "set", "text": "sources: [{name: camera, detect: {ranking: {max_handles: 1}}}]"})
        reader, may_write = self.connect(url.split("?")[0])
        self.assertFalse(may_write)
        reader.send(command)
        self.assertIn("token", self.receive(reader, "refused")["why"])
        writer, may_write = self.connect(url)
        self.assertTrue(may_write)
        writer.send(command)
        number = self.receive(writer, "sent")["id"]
        status = self.receive(writer, "status", lambda message: message["message"]["control_id"] == number)
        self.assertEqual((status["message"]["config_revision"], status["message"]["config_error"]), (2, ""))
        writer.send('{"type":"control","command":"undo"}')
        number = self.receive(writer, "sent")["id"]
        self.receive(writer, "status", lambda message: message["message"]["control_id"] == number)

    def test_clouds_come_in_with_the_token(self):
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(CONFIG))
        _, url = self.start_bridge()
        self.run_program("graspd-simulate", "--width", 160, "--frames", 1)
        answers = self.await_answers(bus, 1)
        cloud = bus.on(CLOUDS)[0]
        reader, _ = self.connect(url.split("?")[0])
        reader.send(cloud[:60000])
        self.assertIn("token", self.receive(reader, "refused")["why"])
        writer, _ = self.connect(url)
        writer.send(cloud)
        answer = self.receive(writer, "handle_list", lambda message: message["channel"] == "BROWSER_HANDLES")["message"]
        self.assertEqual(len(answer["handles"]), answers[0].num_handles)
        self.assertEqual([array("f", handle["position"]) for handle in answer["handles"]],
                         [array("f", handle.position) for handle in answers[0].handles])

    def test_nonsense_is_refused_and_nothing_else(self):
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(CONFIG))
        bridge, url = self.start_bridge()
        client, _ = self.connect(url)
        for message in ("", "{", "[" * 50000, '{"type":"control","command":"set"}', b"", b"\0" * 8, b"\xff" * 100000):
            client.send(message)
            self.receive(client, "refused")
        bus.publish(HANDLES, b"no list")
        wait_until(lambda: "neither a valid handle_list_t" in bridge.err, "the bridge to say so")
        self.assertEqual(bridge.stop()[0], 0, bridge.err)
        self.assertIn("1 invalid messages", bridge.err)
        with self.assertRaises((Closed, OSError)):
            WebSocket(url)

    def test_other_addresses_need_a_token_of_ones_own(self):
        program = self.run_program("graspd-bridge", "--port", 0, "--address", "0.0.0.0", code=1)
        self.assertIn("token", program.err)
        self.assertEqual(program.out, "")

    def test_a_token_of_ones_own(self):
        file = self.folder / "token"
        file.write_text("fifteen letters\n", encoding="ascii")
        for options, environment in ((["--token-file", file], {}), ([], {"GRASPD_BRIDGE_TOKEN": "short"})):
            program = self.run_program("graspd-bridge", "--port", 0, *options, environment=environment, code=1)
            self.assertIn("shorter than 16", program.err)
            self.assertNotIn("fifteen", program.err)
        token = "sixteen-letters!"
        file.write_text(token + "\n", encoding="ascii")
        for options, environment in ((["--token-file", file], {}), ([], {"GRASPD_BRIDGE_TOKEN": token})):
            program = self.start("graspd-bridge", "--port", 0, *options, environment=environment)
            wait_until(program.lines, "the address")
            self.assertTrue(program.lines()[0].endswith("?token=" + token))
            program.stop()


if __name__ == "__main__":
    run_tests()
