# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Clouds in types of others: an LCM log made by their own generated code, played by lcm-logplayer into the daemon, gives the
same handles as our own type, to the bit."""
import itertools
import shutil
import sys

from event_log import write_log
from foreign_messages import Frame, Messages, own_message
from harness import CLOUDS, GraspdTest, run_tests, skip_all

CONFIG = """
sources:
  - name: camera
    channel: GRASPD_CLOUD
    policy: all
    queue_length: 100
"""
# What an answer says of its frame, whatever type that came as.
OF_THE_FRAME = ["points_used", "num_segments", "num_candidates", "status", "status_text"]


def content(value):
    """A decoded message as plain values."""
    if isinstance(value, list):
        return [content(v) for v in value]
    return {k: content(v) for k, v in vars(value).items()} if hasattr(value, "__dict__") else value


class ForeignTypes(GraspdTest):
    def setUp(self):
        super().setUp()
        frame = next(iter(sorted(self.simulate(1, "--sensor", "kinect", width=160).glob("*.pcd"))))
        self.frame = Frame.of_pcd(frame)
        types = self.folder / "types"
        sys.path.insert(0, str(types))
        self.addCleanup(sys.path.remove, str(types))
        self.messages = Messages(types)

    def answers(self, messages, config=CONFIG):
        """What the daemon answers to these, name -> handle list."""
        log = self.folder / "played.log"
        write_log(log, [(CLOUDS, message) for message in messages.values()])
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(config))
        player = self.start(shutil.which("lcm-logplayer"), log)
        answers = self.await_answers(bus, len(messages))
        self.assertEqual(player.wait(), 0, player.err)
        return dict(zip(messages, answers))

    def test_points(self):
        make = self.messages
        messages = {"own": own_message(self.frame)}
        for kind in (make.drake, make.bot_core, make.dimos):
            for big_endian, wide, one_row in itertools.product((False, True), repeat=3):
                layout = {"big_endian": big_endian, "wide": wide, "one_row": one_row}
                messages[f"{kind.__name__} {layout}"] = kind(self.frame, **layout)
        messages["bare"] = make.bare(self.frame)
        answers = self.answers(messages)
        own = answers.pop("own")
        self.assertGreater(len(own.handles), 0)
        for name, answer in answers.items():
            self.assertEqual(content(answer.handles), content(own.handles), name)
            self.assertEqual([getattr(answer, m) for m in OF_THE_FRAME], [getattr(own, m) for m in OF_THE_FRAME], name)
            self.assertEqual((answer.utime, answer.frame_name), (own.utime, own.frame_name), name)
            self.assertEqual(answer.seq, -1 if name.startswith("drake") else own.seq, name)


if __name__ == "__main__":
    for program in ("lcm-logplayer", "lcm-gen"):
        if shutil.which(program) is None:
            skip_all(f"no {program}")
    run_tests()
