#!/usr/bin/env python3
"""Several results in one page of `railwave report`, and pages that have to be thinned."""

import json
import os
import re
import shutil
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import browser  # noqa: E402
from coarse_report import TEMPLATE, CoarseReport, run  # noqa: E402

import h5py  # noqa: E402
import numpy as np  # noqa: E402


def setUpModule():
    global MADE, SMOOTH
    MADE = CoarseReport()
    SMOOTH = MADE.compute("smooth", "contacts.tread.friction=0.05", "parts.roller.position[2]=0.45994")


def tearDownModule():
    MADE.close()


def data_of(page):
    text = page.read_text(encoding="utf-8")
    return json.loads(re.search(r'id="railwave-data">(.*?)</script>', text, re.DOTALL).group(1))


class TestSeveral(unittest.TestCase):
    def test_two_results_side_by_side(self):
        out = MADE.folder / "both.html"
        run("report", MADE.results, SMOOTH, "--out", out)
        with browser.Page(out) as page:
            self.assertEqual(page.ask("[...document.querySelectorAll('#summary h3')].map(one => one.textContent)"),
                             ["rolling", "smooth"])
            self.assertEqual(page.ask("document.querySelectorAll('#patches .card').length"), 2)
            self.assertEqual(page.ask("document.querySelectorAll('#model canvas').length"), 2)
            # One scale for both patches, that of the one with the larger pressure.
            scales = page.ask("[...document.querySelectorAll('#patches .plot.patch:not(.state)')].map(plot =>"
                              " plot.data[0].marker.cmax)")
            largest = []
            for results in (MADE.results, SMOOTH):
                with h5py.File(results) as file:
                    largest.append(1e-6 * file["contact/tread/slave/pressure"][:].max())
            np.testing.assert_allclose(scales, max(largest), rtol=1e-4)
            # Taking one away leaves the other.
            page.ask("document.querySelector('#shown input').click()")
            page.wait_for("document.querySelectorAll('#summary h3').length === 1")
            page.wait_for("document.querySelectorAll('#model canvas').length === 1")
            self.assertEqual(page.text("#summary h3"), "smooth")
            self.assertEqual(page.console(), [])

    def test_many_results_are_rows(self):
        files = []
        for friction in ("0.1", "0.2", "0.3", "0.4"):
            folder = MADE.folder / "members" / f"friction={friction}"
            folder.mkdir(parents=True)
            files.append(shutil.copy(SMOOTH, folder / "results.h5"))
        run("report", *files)
        out = MADE.folder / "members" / "friction=0.1" / "report.html"
        self.assertEqual([one["name"] for one in data_of(out)["results"]],
                         ["friction=0.1", "friction=0.2", "friction=0.3", "friction=0.4"])
        with browser.Page(out, width=390) as page:
            rows = page.ask("[...document.querySelectorAll('#summary .accuracy tbody tr')].map(row =>"
                            " row.cells[0].textContent + ': ' + row.cells[1].textContent)")
            self.assertEqual(rows, [f"friction={friction}: completed" for friction in ("0.1", "0.2", "0.3", "0.4")])
            page.expect_no_sideways_scrolling()
            self.assertEqual(page.console(), [])


class TestBrokenRuns(unittest.TestCase):
    def test_a_run_that_was_killed_amid_values_that_are_not_finite(self):
        broken = shutil.copy(MADE.results, MADE.folder / "broken.h5")
        with h5py.File(broken, "r+") as file:
            file.attrs["completed"] = 0
            file.attrs["reason"] = "a node <b>flew</b> away"
            for name in ("displacement", "velocity"):
                file[f"fields/block.zone/{name}"][-1, 3:6] = np.nan
            file["fields/roller/stress"][-1] = np.nan
            file["history/energy/internal"][-5:] = np.nan
            file["history/energy/balance_error"][-1] = np.inf
        run("report", broken)
        with browser.Page(MADE.folder / "broken.html") as page:
            text = page.text("#summary")
            self.assertIn("not completed at 0.15 ms of 0.15 ms: a node <b>flew</b> away.", text)
            self.assertIn("Energy balance: broken, its values are not finite.", text)
            page.ask("(() => { const list = [...document.querySelectorAll('#model label')].find(one =>"
                     " one.textContent.startsWith('Colour')).querySelector('select');"
                     " list.value = 'displacement:size'; list.dispatchEvent(new Event('change')); })()")
            page.wait_for("document.querySelector('#model .bar').textContent.includes('displacement, size')")
            self.assertNotIn("NaN", page.text("#model .bar"))
            self.assertEqual(page.console(), [])


class TestThinning(unittest.TestCase):
    def test_instants_are_evenly_chosen_and_the_page_says_so(self):
        out = MADE.folder / "thin.html"
        said = run("report", MADE.results, "--instants", "3", "--out", out)
        note = "contact tread: its patches are drawn at 3 of 6 output times, evenly chosen"
        self.assertIn(note, said)
        result = data_of(out)["results"][0]
        self.assertIn(note, result["notes"])
        times = [one["time"] for one in result["fields"]["bodies"][0]["outputs"]]
        np.testing.assert_allclose(times, [0, 9e-5, 1.5e-4], atol=1e-9)
        # The table of the patches keeps all times.
        self.assertEqual(result["contacts"][0]["patches"][0]["values"]["count"], 12)

    def test_a_page_stays_below_the_size_asked_for(self):
        out = MADE.folder / "small.html"
        empty, whole = TEMPLATE.stat().st_size, MADE.page.stat().st_size
        most = 1e-6 * (empty + 0.7 * (whole - empty))
        said = run("report", MADE.results, "--size", f"{most:.4f}", "--out", out)
        self.assertLess(1e-6 * out.stat().st_size, most)
        self.assertRegex(said, r"drawn at [2-5] of 6 output times")


if __name__ == "__main__":
    unittest.main()
