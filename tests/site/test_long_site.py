#!/usr/bin/env python3
"""Every page of the site in a browser without network: light on a screen, dark on a telephone; and the search, from a
server."""

import os
import sys
import threading
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from built_site import PHONE, BuiltSite, Reader, served  # noqa: E402


def setUpModule():
    global SITE
    SITE = BuiltSite()


def tearDownModule():
    SITE.close()


def pages():
    """Names of the pages of documentation."""
    found = [path for path in SITE.folder.glob("*.html") if path.name != "404.html"]
    return sorted(str(path.relative_to(SITE.folder)) for path in (*found, *SITE.folder.glob("studies/*.html")))


class EveryPage(unittest.TestCase):
    def expect_all_to_be_sound(self, dark, **size):
        self.assertGreater(len(pages()), 30)
        with served(SITE.folder) as base, Reader(f"{base}/index.html", dark=dark, **size) as page:
            for name in pages():
                with self.subTest(page=name):
                    page.read(f"{base}/{name}")
                    self.assertEqual(max(page.shade()) < 80, dark)
                    page.expect_no_sideways_scrolling()
                    self.assertEqual(page.faults(), [])
            self.assertEqual([one for one in page.requests() if not one.startswith(base)], [])
            self.assertEqual(page.console(), [])

    def test_light_on_a_screen(self):
        self.expect_all_to_be_sound(dark=False)

    def test_dark_on_a_telephone(self):
        self.expect_all_to_be_sound(dark=True, width=PHONE, height=844)


class Search(unittest.TestCase):
    def expect_pages(self, base):
        with Reader(f"{base}/index.html") as page:
            for words, name in (("Mindlin", "verification.html"), ("fishplate_fit", "case-file.html")):
                page.read(f"{base}/index.html")
                found = page.search(words)
                self.assertTrue(any(f"{base}/{name}" in one for one in found), (words, found))
            self.assertEqual([one for one in page.requests() if not one.startswith(base)], [])
            self.assertEqual(page.console(), [])

    def test_from_a_server(self):
        with served(SITE.folder) as base:
            self.expect_pages(base)

    def test_typed_while_the_worker_starts(self):
        release = threading.Event()
        self.addCleanup(release.set)
        with served(SITE.folder, "/workers/search", release) as base, Reader(f"{base}/index.html") as page:
            page.wait_for(
                "performance.getEntriesByType('resource').some(one =>"
                " one.name.endsWith('search_index.json') && one.responseEnd)"
            )
            page.ask("new Promise(done => setTimeout(done))")  # the theme has taken the index
            page.type_search("Mindlin")
            release.set()
            self.assertTrue(any(f"{base}/verification.html" in one for one in page.found()))
            self.assertEqual(page.console(), [])

    def test_from_a_folder(self):
        self.expect_pages(SITE.address)


if __name__ == "__main__":
    unittest.main()
