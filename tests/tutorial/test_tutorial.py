"""docs/tutorial.md, typed: an own mesh and case, a study of it, its report. Its first case, cases/first_steps.toml, is
typed by test_long_first_steps.py."""

import math
import os
import re
import shutil
import sys
import unittest

import h5py
import numpy as np
from PIL import Image

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from typed import BIN, SOURCE, DeskTest, sections  # noqa: E402

PAGE = os.path.join(SOURCE, "docs", "tutorial.md")
REPORT = (
    os.path.join(SOURCE, "build", "report", "report.html"),
    os.path.join(BIN, "..", "share", "railwave", "report.html"),
)


class Tutorial(DeskTest):
    page = PAGE
    made = {"make_bar.py", "bar.inp", "bar.toml", "bars.toml", "compare_bars.py"}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.desk.type("A mesh of your own")
        cls.said = cls.desk.type("A case of your own")
        cls.compared = cls.desk.type("A study of your own")

    def test_case(self):
        self.assertIn("completed", self.said)
        warnings = set(re.findall(r"warning: (.*)", self.said))
        self.assertEqual(len(warnings), 1, warnings)  # the one that the page explains
        self.assertIn("the nodes jump by 1 m/s in the first step", warnings.pop())
        with h5py.File(self.desk.path("results", "bar", "bar.h5"), "r") as results:
            time = results["history/time"][:]
            stress = results["history/set/bar.middle/stress"][:, 0]
        theory = -math.sqrt(210e9 * 7800)
        arrival = 0.25 / math.sqrt(210e9 / 7800)
        # Half of the stress has come when the wave has; 15 mm of the bar's side blur its front.
        here = time[np.argmax(stress < theory / 2)]
        self.assertAlmostEqual(here, arrival, delta=0.015 / math.sqrt(210e9 / 7800))
        with Image.open(self.desk.path("results", "bar", "bar-scene-stress.png")) as image:
            self.assertGreater(image.width, 1000)

    def test_study_agrees_with_theory_and_with_the_page(self):
        lines = [line for line in self.compared.splitlines() if re.match(r"\s+\d", line)]
        rows = [[float(value) for value in line.split()] for line in lines]
        self.assertEqual(len(rows), 8)
        for velocity, modulus, stress, theory, _ in rows:
            self.assertAlmostEqual(theory, velocity * math.sqrt(1e9 * modulus * 7800) * 1e-6, delta=0.01)
            self.assertAlmostEqual(stress, theory, delta=0.01 * theory)  # as the page says
        with open(PAGE, encoding="utf-8") as file:
            shown = re.findall(r"^\| ([\d.]+) \| (\d+) \| ([\d.]+) \|", file.read(), flags=re.MULTILINE)
        self.assertEqual(len(shown), 4)
        for velocity, modulus, stress in shown:
            found = next(row for row in rows if row[:2] == [float(velocity), float(modulus)])
            self.assertAlmostEqual(found[2], float(stress), delta=0.011)  # a unit of the last digit that is printed
        self.assertTrue(os.path.isfile(self.desk.path("results", "bars", "sweep-stress.png")))

    def test_report(self):
        page = next((path for path in REPORT if os.path.isfile(path)), None)
        if not page:
            self.skipTest("no page of reports: scripts/setup --report makes it")
        self.desk.type("A report to send")
        with open(self.desk.path("results", "bars", "bars.html"), encoding="utf-8") as file:
            text = file.read()
        self.assertIn("bar runs against a wall", text)

    def test_help(self):
        self.assertIn("friction", self.desk.command("railwave help contacts.friction"))


class Page(unittest.TestCase):
    def test_the_first_case_is_that_of_first_steps(self):
        commands = sections(PAGE)["A first case"][0][1].splitlines()
        typed = "".join(text for _, text in sections()["Install and run"])
        for command in commands:
            self.assertIn(command, typed)

    def test_every_section_is_typed(self):
        with open(os.path.abspath(__file__), encoding="utf-8") as file:
            test = file.read()
        for section, blocks in sections(PAGE).items():
            if section != "A first case" and any(language == "sh" for language, _ in blocks):
                self.assertIn(f'type("{section}")', test)


if __name__ == "__main__":
    if not shutil.which("bash"):
        sys.exit(77)
    unittest.main()
