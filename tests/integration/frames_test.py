# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Simulated frames over UDP: each is answered once, with the handles that graspd-detect finds in the file."""
from harness import run_tests
from playback import PlaybackTest

COUNT = 8


class Frames(PlaybackTest):
    def test_clouds(self):
        self.play_and_compare(self.simulate(COUNT), "cloud")

    def test_depth_images(self):
        self.play_and_compare(self.simulate(COUNT), "depth")


if __name__ == "__main__":
    run_tests()
