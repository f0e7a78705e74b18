#!/usr/bin/env python3
"""The site of docs/: scripts/site builds it without warnings, its links lead somewhere, and in a browser without a
network it is read and searched from a folder. test_long_site.py reads every page."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from built_site import PHONE, SOURCE, BuiltSite, Reader  # noqa: E402

sys.path.insert(0, str(SOURCE / "scripts" / "website"))
import links  # noqa: E402
import repository_pages  # noqa: E402


def setUpModule():
    global SITE
    SITE = BuiltSite()


def tearDownModule():
    SITE.close()


class Built(unittest.TestCase):
    def test_says_where_it_is_and_leaves_nothing_else(self):
        self.assertIn(f"{SITE.folder}/index.html", SITE.said)
        self.assertIn(" 0 faults", SITE.said)
        self.assertEqual(os.listdir(SITE.parent), ["site"])

    def test_has_a_page_for_each_of_docs(self):
        for path in (SOURCE / "docs").rglob("*.md"):
            place = repository_pages.place_of(str(path.relative_to(SOURCE)))
            self.assertTrue((SITE.folder / place.site).with_suffix(".html").is_file(), path)

    def test_a_folder_that_is_no_site_is_left_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "mine.txt").write_text("mine", encoding="utf-8")
            done = subprocess.run(
                [SOURCE / "scripts" / "site", "--out", folder], capture_output=True, text=True, check=False
            )
            self.assertEqual(done.returncode, 1)
            self.assertIn("is no site", done.stderr)
            self.assertEqual(os.listdir(folder), ["mine.txt"])


class Links(unittest.TestCase):
    def faults(self, text):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "a.html").write_text(text, encoding="utf-8")
            pathlib.Path(folder, "b.html").write_text("<h1 id='there'>b</h1>", encoding="utf-8")
            site = links.Site(pathlib.Path(folder))
            site.check()
            return site.faults

    def test_what_leads_nowhere_is_found(self):
        self.assertEqual(self.faults("<a href='b.html#there'>b</a> <a href='https://toml.io'>far</a>"), [])
        for wrong in (
            "<a href='c.html'>c</a>", "<a href='b.html#nowhere'>b</a>", "<a href='../x.html'>x</a>",
            "<img src='c.png'>", "<img src='b.html'>",
            "<script src='https://example.org/x.js'></script>", "<p>text\n- an item</p>", "<p>[b](b.md)</p>",
        ):
            self.assertEqual(len(self.faults(wrong)), 1, wrong)

    def test_a_page_that_links_to_nothing_is_refused(self):
        with self.assertRaisesRegex(repository_pages.BrokenLink, "docs/a.md links to ../cases/none.toml"):
            repository_pages.followed("../cases/none.toml", "docs/a.md")


class House(unittest.TestCase):
    def test_picture_is_of_the_present_libraries(self):
        done = subprocess.run(
            [SOURCE / "scripts" / "dev" / "house_picture", "--check"], capture_output=True, text=True, check=False
        )
        self.assertEqual(done.returncode, 0, done.stderr)


class Read(unittest.TestCase):
    def test_light_and_searched(self):
        with Reader(f"{SITE.address}/index.html") as page:
            self.assertEqual(page.shade(), [255, 255, 255])
            found = page.search("fishplate_fit")
            self.assertTrue(any(f"{SITE.address}/case-file.html" in one for one in found), found)
            self.assertEqual((page.faults(), page.requests(), page.console()), ([], [], []))

    def test_dark_on_a_telephone_with_formulas(self):
        with Reader(f"{SITE.address}/theory.html", width=PHONE, height=844, dark=True) as page:
            self.assertLess(max(page.shade()), 80)
            self.assertGreater(page.ask("document.querySelectorAll('.katex-html').length"), 10)
            page.expect_no_sideways_scrolling()
            self.assertEqual((page.faults(), page.requests(), page.console()), ([], [], []))


if __name__ == "__main__":
    unittest.main()
