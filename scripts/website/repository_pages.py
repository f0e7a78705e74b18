"""Which files of the repository are pages of the site, where they stand there, and what links to them become."""

import dataclasses
import pathlib
import posixpath
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Pages of their own by another name: the file of the repository, and its place in the site.
RENAMED = {
    "README.md": "index.md", "docs/index.md": "contents.md", "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md", "benchmarks/RESULTS.md": "benchmarks.md",
}
# What a page names in `` becomes a link when it lies in one of these.
LINKED = ("cases/", "studies/", "scripts/", "data/", "python/", "benchmarks/", "src/", "kernels/", "tests/")
PICTURES = (".png", ".gif", ".jpg", ".svg")
LINES = 400  # of a file's text that its page shows
FENCE = re.compile(r"^\s*(```|~~~)")
LINK = re.compile(r"(!?\[(?:[^\[\]]|\[[^\]]*\])*\])\(([^)\s]+)\)")
LINK_OR_CODE = re.compile(LINK.pattern + r"|(?<!`)`([^`\s]+)`(?!`)")
LANGUAGES = {".toml": "toml", ".py": "python", ".sh": "bash", ".cpp": "cpp", ".hpp": "cpp", ".json": "json"}


class BrokenLink(Exception):
    """A page links to what is not there."""


@dataclasses.dataclass(frozen=True)
class Place:
    """A link's target: a file or folder of the repository, and where the site has it."""

    repository: str
    site: str

    @property
    def is_source(self):
        """Whether it is shown as it is, as text or picture, and is no page of the documentation."""
        return self.site.startswith("source/")

    @property
    def is_picture(self):
        return self.repository.endswith(PICTURES)


def place_of(path):
    """Place of a path of the repository, or None if there is nothing."""
    if not (ROOT / path).exists():
        return None
    if path in RENAMED:
        return Place(path, RENAMED[path])
    if path.startswith("docs/") and (ROOT / path).is_file():
        return Place(path, path[len("docs/"):])
    return Place(path, f"source/{path}" if path.endswith(PICTURES) else f"source/{path}.md")


def repository_path(site):
    """Path in the repository of a page that is no source page."""
    return next((path for path, name in RENAMED.items() if name == site), f"docs/{site}")


def followed(target, path):
    """Place and anchor that a link of the file at `path` leads to; None for what is not of the repository.

    Throws BrokenLink."""
    if re.match(r"[a-z]+:|#", target):
        return None
    name, _, anchor = target.partition("#")
    to = posixpath.normpath(posixpath.join(posixpath.dirname(path), name))
    place = place_of(to)
    if place is None or to.startswith(".."):
        raise BrokenLink(f"{path} links to {target}, and there is no {to}")
    return place, anchor


def named(text):
    """Place of the file that a page names as code, or None."""
    if not text.startswith(LINKED) or not re.fullmatch(r"[\w./-]+", text) or not (ROOT / text).is_file():
        return None
    return place_of(text)


def outside_fences(markdown):
    """Lines with whether they are text, and not of a block of code."""
    fence = False
    for line in markdown.split("\n"):
        edge = bool(FENCE.match(line))
        yield line, not (fence or edge)
        fence ^= edge


def sources_of(markdown, path):
    """Places of the source pages that a page leads to."""
    for line, is_text in outside_fences(markdown):
        if not is_text:
            continue
        for match in LINK_OR_CODE.finditer(line):
            if match[2]:
                found = followed(match[2], path)
                place = found and found[0]
            else:
                place = named(match[3])
            if place and place.is_source:
                yield place


def with_site_links(markdown, path, site, titles):
    """The page with links to where the site has their targets. A link whose text is the name of a page has its title
    from `titles` in place of it."""

    def relative(place, anchor=""):
        name = posixpath.relpath(place.site, posixpath.dirname(site) or ".")
        return f"{name}#{anchor}" if anchor else name

    def changed(match):
        if match[3]:
            place = named(match[3])
            return f"[{match[0]}]({relative(place)})" if place and place.site != site else match[0]
        found = followed(match[2], path)
        if found is None:
            return match[0]
        place, anchor = found
        text = match[1]
        if re.fullmatch(r"\[[\w./-]+\.md\]", text) and place.site in titles:
            text = f"[{titles[place.site]}]"
        return f"{text}({relative(place, anchor)})"

    return "\n".join(
        LINK_OR_CODE.sub(changed, line) if is_text and not line.startswith("#") else line
        for line, is_text in outside_fences(markdown)
    )


def with_blank_lines(markdown):
    """The page with blank lines before lists and tables and around code, without which mkdocs takes them for text."""
    lines, before, was_text = [], "", True
    for line, is_text in outside_fences(markdown):
        starts_table = line.startswith("|") and not before.startswith("|")
        starts_list = re.match(r"([-*]|\d+\.) ", line) and not re.match(r"([-*]|\d+\.) |\s", before)
        meets_code = is_text != was_text and not (line if was_text else before).startswith(" ")
        if before.strip() and line.strip() and (meets_code or (is_text and (starts_table or starts_list))):
            lines.append("")
        lines.append(line)
        before, was_text = line, is_text
    return "\n".join(lines)


def source_page(place):
    """Text of the page of a file, or of a folder with links to its files, and the places that those have."""
    path = ROOT / place.repository
    if path.is_dir():
        files = sorted(file for file in path.iterdir() if file.is_file() and not file.name.startswith("."))
        places = [place_of(str(file.relative_to(ROOT))) for file in files]
        rows = [f"- [{one.repository}]({posixpath.relpath(one.site, posixpath.dirname(place.site))})" for one in places]
        return "\n".join([f"# {place.repository}/", "", *rows, ""]), places
    return f"# {place.repository}\n\n{shown(path)}\n", []


def shown(path):
    """The file's first lines as a block of code."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except UnicodeDecodeError:
        return f"A file of {path.stat().st_size} bytes that is no text."
    language = LANGUAGES.get(path.suffix, "")
    if not language and lines and lines[0].startswith("#!"):
        language = "python" if "python" in lines[0] else "bash"
    said = f"The first {LINES} of {len(lines)} lines.\n\n" if len(lines) > LINES else ""
    return "\n".join([f"{said}~~~~~~{language}", *lines[:LINES], "~~~~~~"])
