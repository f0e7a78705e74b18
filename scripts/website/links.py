#!/usr/bin/python3
"""Checks a built site: every link and anchor leads somewhere, nothing is loaded from another host, and no list or table
was left as text. Addresses of other hosts are counted, with --external printed; none is fetched."""

import argparse
import html.parser
import pathlib
import re
import sys
import urllib.parse

LOADED = {"script": ("src",), "img": ("src",), "link": ("href",), "iframe": ("src",), "source": ("src",)}
OUTSIDE = re.compile(r"(https?:)?//")
STYLE_ADDRESS = re.compile(r"url\(\s*['\"]?([^'\")]+)")


class Page(html.parser.HTMLParser):
    """Anchors of a page, what it links to and loads, and paragraphs that markdown has not understood."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.loads, self.unread = {""}, [], [], []
        self.paragraph, self.quoted = None, 0
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        for name in ("id", "name"):
            if values.get(name) and (name == "id" or tag == "a"):
                self.anchors.add(values[name])
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        for name in LOADED.get(tag, ()):
            # Links of the head that name addresses without loading them.
            if values.get(name) and values.get("rel") not in ("canonical", "prev", "next"):
                self.loads.append(values[name])
        if tag == "p":
            self.paragraph = ""
        self.quoted += tag in ("code", "pre", "script", "style")

    def handle_endtag(self, tag):
        self.quoted -= tag in ("code", "pre", "script", "style")
        if tag == "p" and self.paragraph is not None:
            if re.search(r"^(\||[-*] |```)|\]\(|^#+ ", self.paragraph, re.MULTILINE):
                self.unread.append(self.paragraph.strip()[:80])
            self.paragraph = None

    def handle_data(self, data):
        if self.paragraph is not None and not self.quoted:
            self.paragraph += data


class Site:
    """Pages of a folder, read once each."""

    def __init__(self, folder):
        self.folder = folder.resolve()
        self.pages = {path: Page(path.read_text(encoding="utf-8")) for path in sorted(self.folder.rglob("*.html"))}
        self.external, self.faults, self.checked = set(), [], 0

    def check(self):
        for path, page in self.pages.items():
            where = path.relative_to(self.folder)
            base = self.folder if where.name == "404.html" else path.parent  # its addresses begin with /
            for text in page.unread:
                self.faults.append(f"{where}: not understood as a list, table or link: {text}")
            for address in page.loads:
                if OUTSIDE.match(address):
                    self.faults.append(f"{where}: loads {address} from another host")
                elif address.endswith(".html"):
                    self.faults.append(f"{where}: loads the page {address} as if it were a picture")
                elif not address.startswith("data:"):
                    self.follow(where, base, address)
            for address in page.links:
                self.follow(where, base, address)
        for path in sorted(self.folder.rglob("*.css")):
            self.check_style(path)

    def check_style(self, path):
        where = path.relative_to(self.folder)
        for address in STYLE_ADDRESS.findall(path.read_text(encoding="utf-8")):
            if OUTSIDE.match(address):
                self.faults.append(f"{where}: loads {address} from another host")
            elif not address.startswith(("data:", "#")):
                self.follow(where, path.parent, address)

    def follow(self, where, base, address):
        parts = urllib.parse.urlsplit(address)
        if parts.scheme or parts.netloc:
            if parts.scheme in ("http", "https", "mailto"):
                self.external.add(address)
            else:
                self.faults.append(f"{where}: {address} is no address that a browser opens")
            return
        self.checked += 1
        name = urllib.parse.unquote(parts.path)
        if name.startswith("/"):
            target = self.folder / name.lstrip("/")
        else:
            target = base / name if name else self.folder / where
        target = target.resolve()
        if target.is_dir():
            target = target / "index.html"
        if not target.is_file() or self.folder not in target.parents:
            self.faults.append(f"{where}: {address} leads nowhere")
        elif parts.fragment and target in self.pages:
            # What the theme's script makes has names that begin with __.
            anchor = urllib.parse.unquote(parts.fragment)
            if anchor not in self.pages[target].anchors and not anchor.startswith("__"):
                self.faults.append(f"{where}: {address} leads to no place of that page")


def main():
    parser = argparse.ArgumentParser(prog="scripts/website/links.py", description=__doc__)
    parser.add_argument("folder", type=pathlib.Path, help="the built site")
    parser.add_argument("--external", action="store_true", help="print the addresses of other hosts")
    arguments = parser.parse_args()
    site = Site(arguments.folder)
    if not site.pages:
        parser.error(f"there are no pages in {arguments.folder}: scripts/site builds them")
    site.check()
    for fault in site.faults:
        print(fault)
    if arguments.external:
        print("\n".join(sorted(site.external)))
    print(
        f"{len(site.pages)} pages, {site.checked} links and files within the site, {len(site.faults)} faults;"
        f" {len(site.external)} addresses of other hosts, not fetched"
    )
    return 1 if site.faults else 0


if __name__ == "__main__":
    sys.exit(main())
