"""Tables and pictures of a study."""

import csv
import pathlib
import sys

from steps import PROJECT

sys.path.insert(0, str(PROJECT / "scripts"))
sys.dont_write_bytecode = True
from pictures import style  # noqa: E402
from pictures.output import put_figure  # noqa: E402

style.apply()
import matplotlib.pyplot as plt  # noqa: E402


def off_by(found, thesis):
    return "" if found is None else f"{100 * (found / thesis - 1):+.0f} %"


def frequency_rows(listed):
    """(what, simulated, measured, found) in Hz as rows of the table."""
    return [
        (what, f"{simulated} Hz (measured {measured})" if measured != simulated else f"{simulated} Hz",
         "none" if found is None else f"{found:.0f} Hz", off_by(found, simulated))
        for what, simulated, measured, found in listed
    ]


def write(steps, rows):
    """table.md and table.csv, and the table on standard output."""
    filled = [(*row, *[""] * (4 - len(row))) for row in rows]
    write_table(steps, "table", [("what", "thesis", "found", "off by"), *filled])


def write_table(steps, name, rows):
    """A table, its first row the heading, as Markdown, as CSV and on standard output."""
    heading, *below = rows
    text = "\n".join(["| " + " | ".join(row) + " |" for row in (heading, ["---"] * len(heading), *below)]) + "\n"
    steps.path(f"{name}.md").write_text(text, encoding="utf-8")
    with open(steps.path(f"{name}.csv"), "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows(rows)
    print(text, end="")


def put(steps, figure, name):
    path = pathlib.Path(steps.path(name))
    put_figure(figure, str(path), 150, overwrite=False)
    plt.close(figure)
    print(path)
