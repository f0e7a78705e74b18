#!/usr/bin/env python3
"""The site of docs/: scripts/site builds it without warnings, its links lead somewhere, and in a browser without network
it is read and searched, from a server and from a folder."""

import contextlib
import functools
import http.server
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = pathlib.Path(os.environ.get("RAILWAVE_SOURCE_DIR", HERE.parents[1]))
sys.path[:0] = [str(HERE.parent / "report"), str(SOURCE / "scripts" / "website")]
sys.dont_write_bytecode = True
import browser  # noqa: E402
import links  # noqa: E402
import repository_pages  # noqa: E402

NEEDED = ("/usr/bin/mkdocs", "/usr/share/mkdocs/themes/material", "/usr/share/javascript/katex", "/usr/bin/dot")
PHONE = 390  # px, width of a usual telephone


def setUpModule():
    global MADE, SAID, FOLDER
    lacking = [name for name in NEEDED if not os.path.exists(name)]
    if lacking or not (shutil.which("chromium") and shutil.which("chromedriver")):
        print(f"skipped: scripts/setup --site --tests installs what is missing: {' '.join(lacking)}")
        sys.exit(browser.SKIPPED)
    FOLDER = tempfile.TemporaryDirectory(prefix="railwave-site-")
    MADE = pathlib.Path(FOLDER.name) / "site"
    done = subprocess.run(
        [SOURCE / "scripts" / "site", "--out", MADE], capture_output=True, text=True, check=False, cwd=FOLDER.name
    )
    SAID = done.stdout + done.stderr
    assert done.returncode == 0, SAID


def tearDownModule():
    FOLDER.cleanup()


class Reader(browser.Page):
    """Reads pages of the site, from a folder or from a server on this machine, and asks nobody else."""

    flags = (*browser.FLAGS, "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1")

    def _open(self, path, width, height, dark):
        self.driver.set_script_timeout(browser.PATIENCE)
        self._command("Network.enable")
        self.resize(width, height)
        self.set_dark(dark)
        self.read(path)

    def resize(self, width, height):
        self._command(
            "Emulation.setDeviceMetricsOverride",
            {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600},
        )

    def read(self, address):
        self.driver.get(address)
        self.wait_for("document.readyState === 'complete'")

    def search(self, words):
        """Addresses of what a search finds, best first."""
        self.ask(
            "(() => { const box = document.querySelector('.md-search__input'); box.focus(); box.value = arguments[0];"
            " box.dispatchEvent(new Event('input', {bubbles: true}));"
            " box.dispatchEvent(new KeyboardEvent('keyup', {bubbles: true, key: 'e'})); })()",
            words,
        )
        self.wait_for("document.querySelector('.md-search-result__link')")
        return self.ask("[...document.querySelectorAll('.md-search-result__link')].map(one => one.href)")


@contextlib.contextmanager
def served(folder):
    """Address of a server of the folder on this machine."""

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass

    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=folder)) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_address[1]}"
        finally:
            server.shutdown()
            thread.join()


class Built(unittest.TestCase):
    def test_says_where_it_is_and_leaves_nothing_else(self):
        self.assertIn(f"{MADE}/index.html", SAID)
        self.assertIn(" 0 faults", SAID)
        self.assertEqual(os.listdir(FOLDER.name), ["site"])

    def test_has_a_page_for_each_of_docs(self):
        for path in (SOURCE / "docs").rglob("*.md"):
            place = repository_pages.place_of(str(path.relative_to(SOURCE)))
            self.assertTrue((MADE / place.site).with_suffix(".html").is_file(), path)

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
            "<a href='c.html'>c</a>", "<a href='b.html#nowhere'>b</a>", "<img src='c.png'>", "<a href='../x.html'>x</a>",
            "<script src='https://example.org/x.js'></script>", "<p>text\n- an item</p>", "<p>[b](b.md)</p>",
        ):
            self.assertEqual(len(self.faults(wrong)), 1, wrong)

    def test_a_page_that_links_to_nothing_is_refused(self):
        with self.assertRaisesRegex(repository_pages.BrokenLink, "docs/a.md links to ../cases/none.toml"):
            repository_pages.followed("../cases/none.toml", "docs/a.md")


class Read(unittest.TestCase):
    def expect_a_search(self, page, base):
        for words, name in (("Mindlin", "verification.html"), ("fishplate_fit", "case-file.html")):
            page.read(f"{base}/index.html")
            found = page.search(words)
            self.assertTrue(any(f"{base}/{name}" in one for one in found), (words, found))

    def test_from_a_folder(self):
        with Reader(f"{MADE.as_uri()}/index.html") as page:
            self.expect_a_search(page, MADE.as_uri())
            self.assertEqual((page.requests(), page.console()), ([], []))

    def test_from_a_server(self):
        with served(MADE) as base, Reader(f"{base}/index.html") as page:
            self.expect_a_search(page, base)
            self.assertEqual([one for one in page.requests() if not one.startswith(base)], [])
            self.assertEqual(page.console(), [])

    def test_light_dark_and_on_a_telephone(self):
        pages = sorted(path for path in MADE.glob("*.html") if path.name != "404.html")
        pages += sorted(MADE.glob("studies/*.html"))
        with Reader(f"{MADE.as_uri()}/index.html") as light:
            shade = light.ask("getComputedStyle(document.body).backgroundColor")
        self.assertEqual(shade, "rgb(255, 255, 255)")
        with Reader(f"{MADE.as_uri()}/index.html", width=PHONE, height=844, dark=True) as page:
            for path in pages:
                with self.subTest(page=path.name):
                    page.read(path.as_uri())
                    shade = page.ask("getComputedStyle(document.body).backgroundColor.match(/[0-9.]+/g).map(Number)")
                    self.assertLess(max(shade[:3]), 80)
                    page.expect_no_sideways_scrolling()
                    broken = page.ask("[...document.images].filter(one => !one.naturalWidth).map(one => one.src)")
                    self.assertEqual(broken, [])
                    undrawn = page.ask("document.querySelectorAll('.arithmatex:not(:has(.katex-html))').length")
                    self.assertEqual(undrawn, 0)
            self.assertEqual((page.requests(), page.console()), ([], []))


if __name__ == "__main__":
    unittest.main()
