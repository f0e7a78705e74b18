"""What mkdocs calls while it builds the site (mkdocs.yml): pages of files outside docs/, links to them, and what a
browser needs to search and to draw formulas without network and without server."""

import json
import logging
import pathlib
import re
import shutil
import sys

from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.dont_write_bytecode = True
import repository_pages as pages  # noqa: E402

KATEX = pathlib.Path("/usr/share/javascript/katex")  # Debian's libjs-katex
log = logging.getLogger("mkdocs.hooks.railwave")


def titles_of(nav):
    """Title of each page that the navigation names."""
    titles = {}
    for entry in nav:
        for title, below in entry.items():
            titles.update(titles_of(below) if isinstance(below, list) else {below: title})
    return titles


def without_missing(nav):
    """The navigation without pages that are not there, and without sections that are empty then."""
    kept = []
    for entry in nav:
        for title, below in entry.items():
            if isinstance(below, list):
                below = without_missing(below)
            elif not (pages.ROOT / pages.repository_path(below)).is_file():
                log.info("left out of the navigation: %s is not there", below)
                below = None
            if below:
                kept.append({title: below})
    return kept


def on_config(config):
    config.nav = without_missing(config.nav)
    known = set(titles_of(config.nav))
    docs = pages.ROOT / "docs"
    found = {str(path.relative_to(docs)) for path in docs.rglob("*.md")} - {"index.md"}
    more = sorted(found - known)
    if more:
        config.nav.append({"More": [{title_in(docs / name): name} for name in more]})
    return config


def title_in(path):
    heading = re.search(r"^# (.+)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    return heading[1] if heading else path.stem


def on_files(files, config):
    """Adds the pages of files outside docs/: written beside the site's folder, in NAME-pages."""
    folder = pathlib.Path(config.site_dir).with_name(pathlib.Path(config.site_dir).name + "-pages")
    shutil.rmtree(folder, ignore_errors=True)

    def add(name, content):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
        files.append(File(name, str(folder), config.site_dir, config.use_directory_urls))

    files.remove(files.get_file_from_path("index.md"))
    for path, name in pages.RENAMED.items():
        add(name, (pages.ROOT / path).read_bytes())
    wanted = []
    for file in files.documentation_pages():
        text = pathlib.Path(file.abs_src_path).read_text(encoding="utf-8")
        try:
            wanted += pages.sources_of(text, pages.repository_path(file.src_uri))
        except pages.BrokenLink as error:
            raise PluginError(str(error)) from error
    done = set()
    while wanted:
        place = wanted.pop()
        if place in done:
            continue
        done.add(place)
        if place.is_picture:
            add(place.site, (pages.ROOT / place.repository).read_bytes())
        else:
            text, more = pages.source_page(place)
            add(place.site, text.encode())
            wanted += more
    return files


def on_page_markdown(markdown, page, config, files):
    site = page.file.src_uri
    if site.startswith("source/"):
        return markdown
    titles = titles_of(config.nav)
    linked = pages.with_site_links(markdown, pages.repository_path(site), site, titles)
    return pages.with_blank_lines(linked)


def on_post_build(config):
    site = pathlib.Path(config.site_dir)
    index = site / "search" / "search_index.json"
    found = json.loads(index.read_text(encoding="utf-8"))
    # The text of programs is not searched, that of cases is.
    found["docs"] = [
        one for one in found["docs"] if not one["location"].startswith("source/") or ".toml.html" in one["location"]
    ]
    text = json.dumps(found, separators=(",", ":"))
    index.write_text(text, encoding="utf-8")
    (site / "search" / "search_index.js").write_text(
        f"var __search = {{index: Promise.resolve({text})}}\n", encoding="utf-8"
    )
    if any('class="arithmatex"' in path.read_text(encoding="utf-8") for path in site.rglob("*.html")):
        copy_katex(site / "katex")


def copy_katex(folder):
    if not KATEX.is_dir():
        raise PluginError(f"there is no {KATEX}: scripts/setup --site installs Debian's libjs-katex")
    folder.mkdir(exist_ok=True)
    for name in ("katex.min.css", "katex.min.js"):
        shutil.copy(KATEX / name, folder)
    shutil.copytree(KATEX / "fonts", folder / "fonts", dirs_exist_ok=True)
