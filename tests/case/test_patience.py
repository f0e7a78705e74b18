"""What takes long says what it is at, on the standard error; what is quick says nothing. The timer's signal is sent by
hand here, so that nobody has to wait."""

import os
import signal
import subprocess
import tempfile
import time
import unittest

import extreme_values


class Patience(unittest.TestCase):
    def test_quick_commands_say_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            extreme_values.write_scenes(folder, {"cylinder": extreme_values.SCENES["cylinder"]})
            begun = time.monotonic()
            code, _, err = extreme_values.say(folder, "cylinder")
            self.assertEqual(code, 0)
            if time.monotonic() - begun < 2.5:  # else the machine was busy, and it was right to say something
                self.assertEqual(err, "")

    def test_the_signal_tells_how_long_and_does_no_harm(self):
        with tempfile.TemporaryDirectory() as folder:
            extreme_values.write_scenes(folder, {"cylinder": extreme_values.SCENES["cylinder"]})
            run = subprocess.Popen(
                [
                    extreme_values.PROGRAM, "run", "cylinder.toml", "--set", "time.end=9", "--set",
                    "output.history_interval=1", "--set", "output.progress_interval=0.01",
                ],
                cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            )
            for line in run.stdout:  # the handler is there before anything is printed
                if "step" in line:
                    break
            os.kill(run.pid, signal.SIGALRM)
            self.assertRegex(run.stderr.readline(), r"^railwave: \d+ s so far: \w+")
            run.send_signal(signal.SIGINT)
            run.communicate(timeout=60)
            self.assertEqual(run.returncode, 130)


if __name__ == "__main__":
    unittest.main()
