#!/usr/bin/env python3
"""The page of `railwave report` in a browser without a network: what it says, draws and lets people do."""

import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import browser  # noqa: E402
from coarse_report import CASE, CoarseReport, run  # noqa: E402

import h5py  # noqa: E402
import numpy as np  # noqa: E402

PHONE = 390  # px, width of a usual telephone


def setUpModule():
    global MADE
    MADE = CoarseReport()


def tearDownModule():
    MADE.close()


def brightness(picture):
    return picture.mean()


class TestPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.page = browser.Page(MADE.page)

    @classmethod
    def tearDownClass(cls):
        cls.page.driver.quit()

    def test_summary_has_the_accuracy_of_the_run(self):
        text = self.page.text("#summary")
        with h5py.File(MADE.results) as file:
            energy = file["history/energy"]
            elastic = (energy["internal"][:] + energy["contact"][:]).max()
            share = 100 * np.abs(energy["balance_error"][:]).max() / elastic
        self.assertIn("completed at 0.15 ms", text)
        self.assertIn(f"off by {float(f'{share:.2g}'):g} % of the largest elastic energy", text)
        self.assertIn("Monitor:", text)
        # Cells of 4 mm on a patch of about 9 mm.
        coarse = r"Mesh in the patch of contact tread: coarse, cells of (3\.[5-9]\d*|4|4\.\d+) mm are b/2\."
        self.assertRegex(text, coarse)
        self.assertIn("the contact force also swings as nodes come and go", text)

    def test_curves_have_the_values_of_the_results(self):
        force = self.page.ask(
            "(() => { const plot = [...document.querySelectorAll('#histories .card')].find(card =>"
            " card.querySelector('h3').textContent === 'Contact tread').querySelector('.plot');"
            " return [Array.from(plot.data[0].y), Array.from(plot.data[2].y), plot.data[0].name, plot.data[2].name,"
            " plot.layout.yaxis.title.text, plot.layout.xaxis.title.text]; })()"
        )
        with h5py.File(MADE.results) as file:
            contact = file["history/contact/tread"]
            normal = 1e-3 * np.linalg.norm(contact["normal_force"][:], axis=1)
            tangential = 1e-3 * contact["tangential_force"][:, 0]
        np.testing.assert_allclose(force[0], normal, rtol=1e-6)
        np.testing.assert_allclose(force[1], tangential, rtol=1e-6)
        self.assertEqual(force[2:], ["normal", "tangential x", "forces, kN", "time, ms"])

    def test_a_zoom_moves_all_time_axes_and_a_name_hides_its_curve(self):
        first = "document.querySelector('#histories .plot')"
        buttons = "document.querySelector('#histories .legend button')"
        self.page.ask(f"{buttons}.click()")
        self.page.wait_for(f"{first}.data[0].visible === false")
        self.page.ask(f"{buttons}.click()")
        self.page.wait_for(f"{first}.data[0].visible === true")
        self.page.drag("#histories .plot .nsewdrag", (0.2, 0.5), (0.6, 0.5))
        self.page.wait_for(f"{first}.layout.xaxis.range[0] > 0.02")
        ranges = "[...document.querySelectorAll('#histories .plot')].map(plot => plot.layout.xaxis.range.join())"
        self.page.wait_for(f"new Set({ranges}).size === 1")
        low, high = self.page.ask(f"{first}.layout.xaxis.range")
        self.assertAlmostEqual((high - low) / 0.15, 0.4, delta=0.02)

    def test_values_are_under_the_pointer(self):
        for across in (0.5, 0.52):
            self.page.mouse("mouseMoved", self.page.place_in("#histories .plot .nsewdrag", across, 0.5))
        self.page.wait_for("/normal : [0-9.]+/.test(document.querySelector('#histories .hoverlayer').textContent)")

    def test_table_is_that_of_the_command(self):
        csv = MADE.results.with_suffix(".csv")
        run("contact", MADE.results, "--csv", csv)
        rows = self.page.ask("document.querySelectorAll('#tables tbody tr').length")
        self.assertEqual(rows, len(csv.read_text().splitlines()) - 1)

    def test_tables_are_downloaded_as_the_command_writes_them(self):
        csv = MADE.folder / "patches.csv"
        run("contact", MADE.results, "--csv", csv)
        saved = self.page.download("#download", MADE.folder / "downloads", "rolling-tread-patches.csv")
        wanted = np.genfromtxt(csv, delimiter=",", names=True, usecols=range(1, 10))
        found = np.genfromtxt(saved, delimiter=",", names=True)
        self.assertEqual(saved.read_text().split(",")[:3], ["time [s]", "patch [1]", "nodes_in_contact [1]"])
        for name in wanted.dtype.names:
            there = next(one for one in found.dtype.names if one.rsplit("_", 1)[0] == name)
            # Seven digits of a number in single precision: half a unit of the last, and 2^-24.
            np.testing.assert_allclose(found[there], wanted[name], rtol=5e-7 + 2**-24)

    def test_nothing_is_asked_of_a_network_and_nothing_fails(self):
        self.assertEqual(self.page.requests(), [])
        self.assertEqual(self.page.console(), [])


class TestLooks(unittest.TestCase):
    def test_light_and_dark(self):
        with browser.Page(MADE.page) as light, browser.Page(MADE.page, dark=True) as dark:
            self.assertGreater(brightness(light.picture("#summary")), 180)
            self.assertLess(brightness(dark.picture("#summary")), 75)

    def test_a_page_that_is_open_follows_the_system(self):
        with browser.Page(MADE.page) as page:
            colour = "document.querySelector('#histories .plot').layout.font.color"
            light = page.ask(colour)
            page.set_dark(True)
            page.wait_for(f"{colour} !== '{light}'")
            page.wait_for("document.querySelectorAll('#model canvas').length === 1")
            self.assertLess(brightness(page.picture("#summary")), 75)
            self.assertEqual(page.console(), [])

    def test_a_phone_need_not_be_scrolled_sideways(self):
        with browser.Page(MADE.page, width=PHONE) as page:
            self.assertEqual(page.ask("innerWidth"), PHONE)
            page.expect_no_sideways_scrolling()
            self.assertEqual(page.console(), [])


class TestCommand(unittest.TestCase):
    def test_a_file_of_somebody_else_stays(self):
        other = MADE.results.with_name("mine.html")
        other.write_text("<html>mine</html>")
        self.assertIn("mine.html", run("report", MADE.results, "--out", other, code=2))
        self.assertEqual(other.read_text(), "<html>mine</html>")

    def test_what_is_no_results_file_is_refused(self):
        self.assertIn("no HDF5 file", run("report", CASE, code=2))


if __name__ == "__main__":
    unittest.main()
