# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Clouds and depth images in types of others: an LCM log made by their own generated code, played by lcm-logplayer into the daemon, gives the
same handles as our own type, to the bit."""
import itertools
import shutil
import sys

from event_logs import write_messages
from foreign_messages import Frame, Messages, own_depth_message, own_message
from harness import CLOUDS, TYPES, GraspdTest, run_tests, skip_all
from playback import CONFIG

CAMERA = "    input: {camera: {fx_px: 131.25, fy_px: 131.25, cx_px: 79.5, cy_px: 59.5}}\n"
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
        frame = next(iter(sorted(self.simulate(1, "--sensor", "kinect", width=240).glob("*.pcd"))))
        self.frame = Frame.of_pcd(frame)
        types = self.folder / "types"
        sys.path.insert(0, str(types))
        self.addCleanup(sys.path.remove, str(types))
        self.messages = Messages(types)

    def answers(self, messages, config=CONFIG, channel=CLOUDS):
        """What the daemon answers to these, name -> handle list."""
        log = self.folder / "played.log"
        write_messages(log, [(channel, message) for message in messages.values()])
        bus = self.open_bus()
        self.start_daemon(bus, self.write_config(config))
        player = self.start(shutil.which("lcm-logplayer"), log)
        answers = self.await_answers(bus, len(messages))
        self.assertEqual(player.wait(), 0, player.err)
        return dict(zip(messages, answers))

    def test_points(self):
        make = self.messages
        # An organized cloud's image tells what was seen; without it that is rendered, which moves scores a little.
        messages = {"own": own_message(self.frame), "own in one row": own_message(self.frame.one_row())}
        for kind in (make.drake, make.bot_core, make.dimos):
            for big_endian, wide, one_row in itertools.product((False, True), repeat=3):
                layout = {"big_endian": big_endian, "wide": wide, "one_row": one_row}
                messages[f"{kind.__name__} {layout}"] = kind(self.frame, **layout)
        messages["bare"] = make.bare(self.frame)
        answers = self.answers(messages)
        organized, one_row = answers.pop("own"), answers.pop("own in one row")
        self.assertGreater(len(organized.handles), 0)
        self.assertGreater(len(one_row.handles), 0)
        for name, answer in answers.items():
            own = one_row if "'one_row': True" in name or name == "bare" else organized
            self.assertEqual(content(answer.handles), content(own.handles), name)
            self.assertEqual([getattr(answer, m) for m in OF_THE_FRAME], [getattr(own, m) for m in OF_THE_FRAME], name)
            self.assertEqual((answer.utime, answer.frame_name), (own.utime, own.frame_name), name)
            self.assertEqual(answer.seq, -1 if name.startswith("drake") else own.seq, name)

    def test_channels_of_dimos(self):
        """Their names have a type's at the end."""
        channel = "/camera/points#sensor_msgs.PointCloud2"
        layout = {"big_endian": False, "wide": False, "one_row": False}
        answers = self.answers({"dimos": self.messages.dimos(self.frame, **layout)},
                               CONFIG.replace("GRASPD_CLOUD", f'"{channel}"'), channel)
        self.assertGreater(len(answers["dimos"].handles), 0)
        self.assertEqual(answers["dimos"].source_channel, channel)

    def test_depth(self):
        make = self.messages
        messages = {"own": own_depth_message(self.frame)}
        for zipped in (False, True):
            messages[f"images_t zipped={zipped}"] = make.images(self.frame, zipped)
        for packing, big_endian, metres in itertools.product((0, 1, 3), (False, True), (False, True)):
            if packing == 3 and (metres or big_endian):
                continue  # a PNG has no such pixels, and its own order of bytes
            messages[f"drake packing={packing} {big_endian=} {metres=}"] = make.image_array(
                self.frame, packing, big_endian, metres)
        answers = self.answers(messages, CONFIG + CAMERA)
        own = answers.pop("own")
        self.assertGreater(len(own.handles), 0)
        for name, answer in answers.items():
            self.assertEqual(content(answer.handles), content(own.handles), name)
            self.assertEqual([getattr(answer, m) for m in OF_THE_FRAME], [getattr(own, m) for m in OF_THE_FRAME], name)
            self.assertEqual(answer.utime, own.utime, name)
            drake = name.startswith("drake")  # images_t has neither
            self.assertEqual((answer.seq, answer.frame_name), (own.seq, own.frame_name) if drake else (-1, ""), name)

    def test_depth_without_intrinsics(self):
        """Refused, with the remedy's name."""
        answers = self.answers({"bot_core": self.messages.images(self.frame, True),
                                "drake": self.messages.image_array(self.frame, 3)})
        for name, answer in answers.items():
            self.assertEqual(answer.status, TYPES["handle_list_t"].constants["REFUSED"], name)
            self.assertIn("bad_calibration", answer.status_text)
            self.assertIn("input.camera of the source", answer.status_text)


if __name__ == "__main__":
    for program in ("lcm-logplayer", "lcm-gen"):
        if shutil.which(program) is None:
            skip_all(f"no {program}")
    run_tests()
