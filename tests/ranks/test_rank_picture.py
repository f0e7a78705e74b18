#!/usr/bin/env python3
"""`railwave mesh --ranks N` writes which element is whose, as `railwave check --ranks N` counts them, and
scripts/picture draws it."""

import os
import pathlib
import re
import subprocess
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from test_ranks import PROGRAM, Ranks, need_ranks, scene  # noqa: E402

PICTURE = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"]) / "scripts" / "picture"


class RankPicture(Ranks):
    def call(self, *words, code=0):
        done = subprocess.run(list(map(str, words)), cwd=self.folder, text=True, capture_output=True, check=False)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def mesh(self, *options):
        self.call(PROGRAM, "mesh", "case.toml", "--out", "model.h5", "--overwrite", *options)
        with h5py.File(self.folder / "model.h5") as file:
            return {name: {key: group[key][:] for key in group} for name, group in file["parts"].items()}

    def test_elements_of_each_rank(self):
        self.write(scene("penalty"))
        for ranks in (2, 3):
            said = self.call(PROGRAM, "check", "case.toml", "--ranks", ranks)
            self.assertIn(f"railwave mesh case.toml --ranks {ranks}", said)
            counted = [int(one) for one in re.findall(r"rank \d: (\d+) elements", said)]
            parts = self.mesh("--ranks", ranks)
            found = np.concatenate([part["rank"] for part in parts.values()])
            self.assertEqual(list(np.bincount(found, minlength=ranks)), counted)
        self.assertIn("rank", (self.folder / "model.xdmf").read_text())
        self.call(sys.executable, "-B", PICTURE, "--mesh", "model.h5")
        self.assertGreater((self.folder / "model-ranks.png").stat().st_size, 10000)

    def test_elements_at_a_contact_by_multipliers_are_of_rank_0(self):
        for kind in ("multiplier", "penalty"):
            self.write(scene(kind))
            parts = self.mesh("--ranks", 3)
            upper = parts["upper"]
            heights = upper["coordinates"][upper["connectivity"]][:, :, 2].min(axis=1)
            lowest = heights < heights.min() + 1e-9
            self.assertEqual(np.all(upper["rank"][lowest] == 0), kind == "multiplier")
            self.assertTrue(np.any(np.concatenate([part["rank"] for part in parts.values()]) > 0))

    def test_without_ranks(self):
        self.write(scene("penalty"))
        self.assertNotIn("rank", self.mesh()["upper"])
        self.call(sys.executable, "-B", PICTURE, "--mesh", "model.h5")
        self.assertFalse((self.folder / "model-ranks.png").exists())

    def test_refused(self):
        self.write(scene("penalty"))
        self.assertIn("--ranks", self.call(PROGRAM, "mesh", "case.toml", "--ranks", "0", code=2))


if __name__ == "__main__":
    need_ranks()
    unittest.main()
