"""Every key of the case file is tried with every number and text of extreme_values.py: `railwave check` answers within
seconds, with exit code 0 or 2, and its message names the key or the entry, in fewer than 600 characters, without
infinities and endless digits."""

import os
import re
import tempfile
import unittest

import extreme_values


class ExtremeValues(unittest.TestCase):
    def test_scenes_are_sound(self):
        with tempfile.TemporaryDirectory() as folder:
            extreme_values.write_scenes(folder)
            for scene in extreme_values.SCENES:
                code, _, err = extreme_values.say(folder, scene)
                self.assertEqual((code, re.sub(r"railwave: \d+ s so far: .*\n", "", err)), (0, ""), scene)

    def test_every_key(self):
        with tempfile.TemporaryDirectory() as outer:
            folder = os.path.join(outer, "inner")  # what stands for a path is "../x", which must not be there
            os.mkdir(folder)
            wanted = list(extreme_values.trials())
            self.assertGreater(len(wanted), 3000)
            faults = extreme_values.sweep(folder, wanted)
            self.assertEqual(faults, [], "\n".join(faults))


if __name__ == "__main__":
    unittest.main()
