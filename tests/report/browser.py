"""A report in headless Chromium, cut off from any network, and what the tests ask of it."""

import base64
import io
import json
import pathlib
import shutil
import sys
import time

SKIPPED = 77  # exit code of a test that this machine cannot run

try:
    import numpy as np
    from PIL import Image
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
except ImportError:
    sys.exit(SKIPPED)

PATIENCE = 240  # s, for what takes a second or two on an idle machine
FLAGS = (
    "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader", "--disable-background-networking", "--hide-scrollbars",
    "--host-resolver-rules=MAP * ~NOTFOUND",
)


def expect_browser(template):
    """Ends the test as skipped where there is no Chromium with its driver, or no page was made."""
    chromium, driver = shutil.which("chromium"), shutil.which("chromedriver")
    if not (chromium and driver and template.is_file()):
        print("skipped: scripts/setup --tests installs Chromium and makes the page of reports")
        sys.exit(SKIPPED)


class Page:
    """A report that is open. Everything that the page writes to the console, and every address that it asks for, is
    kept."""

    flags = FLAGS

    def __init__(self, path, width=1280, height=900, dark=False):
        options = Options()
        options.binary_location = shutil.which("chromium")
        for flag in self.flags:
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        try:
            self._open(path, width, height, dark)
        except BaseException:
            self.driver.quit()
            raise

    def _open(self, path, width, height, dark):
        self.driver.set_script_timeout(PATIENCE)
        self._command("Network.enable")
        self._command(
            "Emulation.setDeviceMetricsOverride",
            {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600},
        )
        self.set_dark(dark)
        self.driver.get(pathlib.Path(path).resolve().as_uri())
        self.wait_for("document.body.dataset.ready || document.body.dataset.failed")
        if self.ask("document.body.dataset.failed"):
            raise AssertionError(f"the page could not be drawn: {self.console()}")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()

    def _command(self, name, arguments=None):
        return self.driver.execute_cdp_cmd(name, arguments or {})

    def set_dark(self, dark):
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self._command("Emulation.setEmulatedMedia", {"features": [scheme]})

    def ask(self, expression, *arguments):
        """Value of a JavaScript expression; arguments are arguments[0] and so on."""
        return self.driver.execute_script(f"return {expression}", *arguments)

    def wait_for(self, expression):
        end = time.monotonic() + PATIENCE
        while not self.ask(expression):
            if time.monotonic() > end:
                raise AssertionError(f"this has not become true: {expression}; console: {self.console()}")
            time.sleep(0.05)

    def text(self, selector):
        return self.ask("document.querySelector(arguments[0]).innerText", selector)

    def console(self):
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def requests(self):
        """Addresses that the page has asked for, other than files and data that it holds itself."""
        addresses = []
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                addresses.append(message["params"]["request"]["url"])
        return [address for address in addresses if not address.startswith(("file:", "data:", "blob:"))]

    def expect_no_sideways_scrolling(self):
        """Fails, naming the elements that are too wide, where the page is wider than its window."""
        width = self.ask("document.documentElement.clientWidth")
        if self.ask("document.documentElement.scrollWidth") <= width:
            return
        wide = self.ask(
            "[...document.querySelectorAll('body *')].map(one => [one, one.getBoundingClientRect().right])"
            ".filter(([, right]) => right > arguments[0] + 0.5).slice(0, 20).map(([one, right]) =>"
            " `${one.tagName}.${one.className}#${one.id} to ${Math.round(right)}: ${one.textContent.slice(0, 60)}`)",
            width,
        )
        raise AssertionError(f"wider than {width}: {wide}")

    def move_slider(self, selector, position):
        self.ask(
            "(() => { const s = document.querySelector(arguments[0]); s.value = arguments[1];"
            " s.dispatchEvent(new Event('input', {bubbles: true})); })()",
            selector, position,
        )

    def place_in(self, selector, across, down):
        """Place in the window, px, of a point of an element, which is scrolled into it; 0 to 1 from its upper left."""
        return self.ask(
            "(() => { const one = document.querySelector(arguments[0]); one.scrollIntoView({behavior: 'instant',"
            " block: 'center'}); const r = one.getBoundingClientRect();"
            " return [r.x + arguments[1] * r.width, r.y + arguments[2] * r.height]; })()",
            selector, across, down,
        )

    def mouse(self, kind, place):
        """Kind: mouseMoved, mousePressed or mouseReleased, with the left button."""
        button = {} if kind == "mouseMoved" else {"button": "left", "clickCount": 1}
        self._command("Input.dispatchMouseEvent", {"type": kind, "x": place[0], "y": place[1], **button})

    def drag(self, selector, start, end):
        """Drags from one point of an element to another one."""
        first = self.place_in(selector, *start)
        self.mouse("mouseMoved", first)
        self.mouse("mousePressed", first)
        last = self.place_in(selector, *end)
        for part in (0.3, 0.6, 1):
            place = [a + part * (b - a) for a, b in zip(first, last)]
            self._command(
                "Input.dispatchMouseEvent", {"type": "mouseMoved", "x": place[0], "y": place[1], "button": "left"}
            )
        self.mouse("mouseReleased", last)

    def download(self, button, folder, name):
        """Path of the file of that name that a click on the button saves in the folder."""
        folder.mkdir(exist_ok=True)
        self._command("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(folder)})
        self.ask("document.querySelector(arguments[0]).click()", button)
        end = time.monotonic() + PATIENCE
        while not (folder / name).is_file():
            if time.monotonic() > end:
                raise AssertionError(f"{name} was not saved; there are {sorted(folder.iterdir())}")
            time.sleep(0.05)
        return folder / name

    def picture(self, selector=None):
        """(height, width, 3) of an element, or of the whole page."""
        where = self.ask(
            "(() => { const r = (arguments[0] ? document.querySelector(arguments[0]) : document.documentElement)"
            ".getBoundingClientRect(); return [r.x + scrollX, r.y + scrollY, r.width, r.height]; })()",
            selector,
        )
        clip = dict(zip(("x", "y", "width", "height"), where), scale=1)
        shot = self._command("Page.captureScreenshot", {"captureBeyondViewport": True, "clip": clip})
        with Image.open(io.BytesIO(base64.b64decode(shot["data"]))) as image:
            return np.asarray(image.convert("RGB"))
