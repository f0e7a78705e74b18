"""Columns of numbers by name out of a text file, for scripts: what is not wholly understood is refused with file, line
and column."""

import math
import re

NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)


class TableError(ValueError):
    """What is wrong with a file, and how to mend it."""


def parse_number(text):
    """A finite decimal number with nothing beside it, in any locale; None where it is something else."""
    value = float(text) if NUMBER.fullmatch(text) else math.nan
    return value if math.isfinite(value) else None


def why_no_number(text):
    if not text:
        return "is empty; write a number, such as 0.5"
    if text[0] in "\"'":
        return "stands in quotes; write the number without them"
    mended = text.replace(",", ".")
    if text.count(",") == 1 and parse_number(mended) is not None:
        return f"has a comma in it: a decimal comma? then write {mended}; thousands are not separated"
    if NUMBER.fullmatch(text):
        return "is too large; at most 1.79e308 can be computed with"
    if NUMBER.match(text):
        return (
            "has something behind the number; write the number alone, with a decimal point, thousands without"
            " separators"
        )
    return "is no finite decimal number; write one such as 0.5 or 5e-1"


def decoded(path):
    with open(path, "rb") as file:
        content = file.read()
    if content[:2] in (b"\xff\xfe", b"\xfe\xff") or b"\0" in content[:4]:
        raise TableError(
            f"{path}:1: the file is UTF-16 or UTF-32 text, or none; save it as UTF-8 (in a spreadsheet: CSV, encoding"
            " UTF-8)"
        )
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        raise TableError(f"{path}:{line}: is no UTF-8 text; save it as UTF-8") from None


def split(line, separator):
    """Cells without blanks around them; a text in quotes may hold the separator."""
    cells, cell, quoted = [], "", False
    for letter in line:
        if letter == '"':
            quoted = not quoted
        if letter == separator and not quoted:
            cells.append(cell.strip())
            cell = ""
        else:
            cell += letter
    return [*cells, cell.strip()]


def unquoted(text):
    return text[1:-1] if len(text) > 1 and text[0] == text[-1] == '"' else text


def read_table(path, numbers, texts=()):
    """Rows of a file whose first line names its columns, which commas, semicolons or tabs separate; empty lines and
    those that begin with # are left out. Of columns not asked for only their presence is looked at.
    :param numbers: names of columns whose cells must be numbers
    :param texts: names of columns whose cells are kept as text
    :return: list of dictionaries, with the file's line as "line"
    :raises TableError: with file, line, column, what was found and what is wanted"""
    names, separator, rows = None, None, []
    for number, line in enumerate(decoded(path).replace("\r\n", "\n").replace("\r", "\n").split("\n"), start=1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        where = f"{path}:{number}"
        if names is None:
            separator = next((one for one in ";\t" if one in line), ",")
            names = [unquoted(cell) for cell in split(line, separator)]
            for name in [*numbers, *texts]:
                if names.count(name) != 1:
                    raise TableError(
                        f"{where}: the line of names is '{line.strip()[:80]}', must have the column {name} once"
                    )
            continue
        cells = split(line, separator)
        if len(cells) != len(names):
            raise TableError(
                f"{where}: has {len(cells)} values, must have {len(names)}, one for each name of the first line"
            )
        row = {"line": number, **{name: unquoted(cells[names.index(name)]) for name in texts}}
        for name in numbers:
            text = cells[names.index(name)]
            row[name] = parse_number(text)
            if row[name] is None:
                raise TableError(
                    f"{where}: column {names.index(name) + 1} ({name}): '{text[:40]}' {why_no_number(text)}"
                )
        rows.append(row)
    if names is None:
        raise TableError(f"{path}:1: is empty, must have a line that names the columns {', '.join([*numbers, *texts])}")
    return rows
