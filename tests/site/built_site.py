"""The site of docs/, built by scripts/site for tests, and a browser without network that reads it."""

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

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = pathlib.Path(os.environ.get("RAILWAVE_SOURCE_DIR", HERE.parents[1]))
sys.path.insert(0, str(HERE.parent / "report"))
sys.dont_write_bytecode = True
import browser  # noqa: E402

NEEDED = ("/usr/bin/mkdocs", "/usr/share/mkdocs/themes/material", "/usr/share/javascript/katex", "/usr/bin/dot")
PHONE = 390  # px, width of a usual telephone


class BuiltSite:
    """The site in a folder of its own, and what scripts/site said. Ends the test as skipped where something is not
    installed."""

    def __init__(self):
        lacking = [name for name in NEEDED if not os.path.exists(name)]
        lacking += [name for name in ("chromium", "chromedriver") if not shutil.which(name)]
        if lacking:
            print(f"skipped: scripts/setup --site --tests installs what is missing: {' '.join(lacking)}")
            sys.exit(browser.SKIPPED)
        self._folder = tempfile.TemporaryDirectory(prefix="railwave-site-")
        self.parent = pathlib.Path(self._folder.name)
        self.folder = self.parent / "site"
        self.address = self.folder.as_uri()
        done = subprocess.run(
            [SOURCE / "scripts" / "site", "--out", self.folder], capture_output=True, text=True, check=False
        )
        self.said = done.stdout + done.stderr
        assert done.returncode == 0, self.said

    def close(self):
        self._folder.cleanup()


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

    def shade(self):
        """Red, green and blue of the page's ground."""
        return self.ask("getComputedStyle(document.body).backgroundColor.match(/[0-9.]+/g).slice(0, 3).map(Number)")

    def faults(self):
        """What is wrong with the page that is open: pictures and formulas that were not drawn."""
        return self.ask(
            "[...[...document.images].filter(one => !one.naturalWidth).map(one => one.src),"
            " ...[...document.querySelectorAll('.arithmatex')].filter(one => !one.querySelector('.katex-html'))"
            ".map(one => one.textContent)]"
        )

    def type_search(self, words):
        self.ask(
            "(() => { const box = document.querySelector('.md-search__input'); box.focus(); box.value = arguments[0];"
            " box.dispatchEvent(new Event('input', {bubbles: true}));"
            " box.dispatchEvent(new KeyboardEvent('keyup', {bubbles: true, key: 'e'})); })()",
            words,
        )

    def search(self, words):
        """Addresses of what a search finds, best first."""
        self.type_search(words)
        return self.found()

    def found(self):
        self.wait_for("document.querySelector('.md-search-result__link')")
        return self.ask("[...document.querySelectorAll('.md-search-result__link')].map(one => one.href)")


@contextlib.contextmanager
def served(folder, held="", release=None):
    """Address of a server of the folder on this machine.
    @param held paths with this in them are answered when the event `release` is set"""

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def do_GET(self):
            if held and held in self.path:
                release.wait()
            super().do_GET()

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
