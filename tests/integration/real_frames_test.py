# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Real frames over UDP, as in frames_test: the folder is named by GRASPD_FRAMES, or lies beside the checkout."""
import os
import pathlib

from harness import SANITIZED, run_tests, skip_all
from playback import PlaybackTest

BESIDE = pathlib.Path(__file__).resolve().parents[3] / "shared/frames"
FOLDER = pathlib.Path(os.environ.get("GRASPD_FRAMES") or BESIDE)


class RealFrames(PlaybackTest):
    def frames(self):
        """The folder; under a sanitizer, where a frame takes half a minute, one of its first two."""
        if not SANITIZED:
            return FOLDER
        folder = self.folder / "frames"
        folder.mkdir()
        for path in sorted(FOLDER.glob("*.pcd"))[:2]:
            (folder / path.name).symlink_to(path.resolve())
        return folder

    def test_clouds(self):
        self.play_and_compare(self.frames(), "cloud")

    def test_depth_images(self):
        self.play_and_compare(self.frames(), "depth")


if __name__ == "__main__":
    if not list(FOLDER.glob("*.pcd")):
        skip_all(f"no real frames: {FOLDER} holds no .pcd file; GRASPD_FRAMES names another folder")
    run_tests()
