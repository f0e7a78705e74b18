#!/usr/bin/env python3
"""Contact patches and bodies in the page of `railwave report`: their sliders, values and colours."""

import csv
import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import browser  # noqa: E402
from coarse_report import CoarseReport, run  # noqa: E402

import h5py  # noqa: E402
import numpy as np  # noqa: E402

FIGURES = (("normal force", "normal_force", 1e-3), ("largest pressure", "peak_nodal_pressure", 1e-6))
STICK, SLIP = (59, 125, 216), (232, 134, 46)  # of style.css, light


def setUpModule():
    global MADE
    MADE = CoarseReport()


def tearDownModule():
    MADE.close()


def share_of_colour(picture, colour):
    return np.mean(np.abs(picture.astype(int) - colour).max(axis=2) < 12)


class TestPatches(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.page = browser.Page(MADE.page)
        table = MADE.folder / "patches.csv"
        run("contact", MADE.results, "--csv", table)
        with open(table, encoding="utf-8") as file:
            cls.rows = [row for row in csv.DictReader(file) if row["patch"] == "1"]

    @classmethod
    def tearDownClass(cls):
        cls.page.driver.quit()

    def figure(self, name):
        return self.page.ask(
            "[...document.querySelectorAll('#patches .figures tr')].find(row =>"
            " row.cells[0].textContent === arguments[0]).cells[1].textContent", name
        )

    def go_to(self, output):
        self.page.move_slider("#patches input[type=range]", output)
        time = 1e3 * float(self.rows[output]["time"])
        shown = "document.querySelector('#patches .card .faint').textContent"
        self.page.wait_for(f"{shown}.includes('t = {time:.4f} ms')")
        self.page.wait_for("document.querySelector('#patches .figures table') !== null")

    def test_slider_moves_the_values(self):
        seen = []
        for output in (1, 3, 5):
            self.go_to(output)
            row = self.rows[output]
            for name, column, unit in FIGURES:
                wanted = f"{float(f'{unit * float(row[column]):.4g}'):g}"
                self.page.wait_for(f"document.querySelector('#patches .figures').textContent.includes('{wanted} ')")
                self.assertEqual(self.figure(name).split()[0], wanted)
            seen.append(self.figure("normal force"))
        self.assertEqual(len(set(seen)), 3)

    def test_under_the_pointer_are_the_nodes_of_the_results(self):
        self.go_to(5)
        pressures = self.page.ask(
            "document.querySelector('#patches .plot.patch').data.at(-1).text.map(text =>"
            " Number(text.match(/pressure ([0-9.e+-]+) MPa/)[1]))"
        )
        with h5py.File(MADE.results) as file:
            slave = file["contact/tread/slave"]
            touching = np.linalg.norm(slave["normal_force"][5], axis=1) > 1e-3
            wanted = 1e-6 * slave["pressure"][5][touching]
        np.testing.assert_allclose(sorted(pressures), sorted(wanted), rtol=6e-4)

    def test_axes_are_alike_and_in_mm(self):
        layout = self.page.ask("(({xaxis, yaxis}) => [xaxis.title.text, yaxis.title.text, yaxis.scaleanchor])"
                               "(document.querySelector('#patches .plot.patch').layout)")
        self.assertEqual(layout, ["rolling direction, mm", "lateral, mm", "x"])

    def test_stick_and_slip_are_seen(self):
        self.go_to(4)
        row = self.rows[4]
        self.page.wait_for("document.querySelector('#patches .figures').textContent.includes('3 of 7')")
        picture = self.page.picture("#patches .plot.state")
        slipping, touching = float(row["slipping_by_solver"]), float(row["nodes_in_contact"])
        stick, slip = share_of_colour(picture, STICK), share_of_colour(picture, SLIP)
        self.assertGreater(stick, 0.01)
        self.assertAlmostEqual(slip / (stick + slip), slipping / touching, delta=0.15)

    def test_pressure_colours_its_place(self):
        self.go_to(5)
        shear = self.page.picture("#patches .plot.patch")
        self.page.ask(
            "(() => { const list = document.querySelector('#patches select option[value=slip]').parentElement;"
            " list.value = 'slip'; list.dispatchEvent(new Event('change')); })()"
        )
        bar = "document.querySelector('#patches .plot.patch').data[0].marker.colorbar.title.text"
        self.page.wait_for(f"{bar} === 'micro-slip, m/s'")
        self.assertGreater(np.mean(shear != self.page.picture("#patches .plot.patch")), 0.02)
        self.assertEqual(self.page.console(), [])


class TestBodies(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.page = browser.Page(MADE.page)

    @classmethod
    def tearDownClass(cls):
        cls.page.driver.quit()

    def choose(self, label, value):
        self.page.ask(
            "(() => { const list = [...document.querySelectorAll('#model label')].find(one =>"
            " one.textContent.startsWith(arguments[0])).querySelector('select');"
            " list.value = arguments[1]; list.dispatchEvent(new Event('change')); })()",
            label, value,
        )

    def ends(self):
        return [self.page.text("#model .low"), self.page.text("#model .high")]

    def test_only_outer_faces_are_there(self):
        body = "JSON.parse(document.getElementById('railwave-data').textContent).results[0].fields.bodies"
        names = self.page.ask(f"{body}.map(one => [one.name, one.contained])")
        self.assertEqual(names, [["block", False], ["block.zone", True], ["roller", False]])
        with h5py.File(MADE.results) as file:
            cells = file["fields/block/connectivity"][:]
        sides = cells[:, [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]]
        _, count = np.unique(np.sort(sides.reshape(-1, 4), axis=1), axis=0, return_counts=True)
        self.assertEqual(self.page.ask(f"{body}[0].faces"), int((count == 1).sum()))
        self.assertIn("fields of block: the outer faces of its", self.page.text("#about"))

    def test_scale_has_the_largest_displacement_of_the_results(self):
        self.choose("Colour", "displacement:x")
        self.choose("Scale", "all")
        with h5py.File(MADE.results) as file:
            largest = 1e3 * max(file[f"fields/{name}/displacement"][..., 0].max() for name in ("roller", "block"))
        self.page.wait_for(f"document.querySelector('#model .high').textContent.startsWith('{largest:.3g}')")
        self.assertAlmostEqual(float(self.ends()[1].split()[0]), largest, delta=2e-4 * largest)

    def test_slider_moves_the_roller_and_pointer_names_a_value(self):
        self.choose("Colour", "velocity:size")
        self.page.wait_for("document.querySelector('#model .bar').textContent.includes('velocity, size')")
        last = self.page.picture("#model canvas")
        self.page.move_slider("#model input[type=range]", 0)
        self.page.wait_for("document.querySelector('#model output').textContent === 't = 0.0000 ms'")
        self.page.ask("(async () => { for (let i = 0; i < 5; ++i) await new Promise(requestAnimationFrame); })()")
        self.assertGreater(np.mean(last != self.page.picture("#model canvas")), 0.002)
        # The roller, above the middle of the picture, moves with up to twice 30 m/s.
        self.page.ask(
            "(() => { const canvas = document.querySelector('#model canvas'), box = canvas.getBoundingClientRect();"
            " for (let y = 0.2; y < 0.9; y += 0.05) { canvas.dispatchEvent(new PointerEvent('pointermove', {clientX:"
            " box.x + 0.47 * box.width, clientY: box.y + y * box.height}));"
            " if (document.querySelector('#model .under').textContent.startsWith('roller')) break; } })()"
        )
        found = self.page.text("#model .under")
        self.assertRegex(found, r"^roller: [0-9.]+ m/s$")
        self.assertLess(float(found.split()[1]), 60)
        self.assertGreater(float(found.split()[1]), 0.5)
        # Dragging turns it.
        before = self.page.picture("#model canvas")
        self.page.drag("#model canvas", (0.3, 0.5), (0.6, 0.4))
        self.page.ask("(async () => { for (let i = 0; i < 5; ++i) await new Promise(requestAnimationFrame); })()")
        self.assertGreater(np.mean(before != self.page.picture("#model canvas")), 0.02)
        self.assertEqual(self.page.console(), [])


if __name__ == "__main__":
    unittest.main()
