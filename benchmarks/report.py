#!/usr/bin/python3
"""Writes RESULTS.md, and a picture of run time against error, from the results files of the benchmarks."""

import argparse
import csv
import os
import sys

sys.dont_write_bytecode = True
import report_work_error  # noqa: E402

HEAD = """# Benchmark results

Written by `scripts/benchmark`; do not edit. Every figure is from a file in `results/`, which names machine, command \
and date.
Rates are the best of several repetitions after a warm-up; *spread* is (slowest - fastest) / fastest, in bold above \
20 %. A
load average above the threads of the run means that others used the machine. Such times are not to be trusted.
"""


class Results:
    """One results file: facts about the machine, and rows (dictionaries of text)."""

    def __init__(self, path):
        self.name = os.path.splitext(os.path.basename(path))[0]
        self.facts = {}
        lines = []
        with open(path, encoding="utf-8", newline="") as file:
            for line in file:
                if line.startswith("# "):
                    key, _, value = line[2:].partition(": ")
                    self.facts[key] = value.strip()
                else:
                    lines.append(line)
        self.rows = list(csv.DictReader(lines))

    @property
    def program(self):
        return self.facts.get("program", "")

    @property
    def back_end(self):
        threads = self.facts.get("threads")
        if self.facts.get("back end") == "Serial" or threads is None:
            return self.facts.get("back end", "?")
        return f"{self.facts['back end']}, {threads} thread" + ("s" if threads != "1" else "")

    def select(self, **wanted):
        return [row for row in self.rows if all(row.get(key) == value for key, value in wanted.items())]


def number(row, key):
    text = row.get(key) or ""
    try:
        return float(text)
    except ValueError:
        return None


def shown(value, pattern="{:.2f}", scale=1.0):
    return "" if value is None else pattern.format(scale * value)


def spread(row):
    """In bold where a figure is not to be trusted."""
    value = number(row, "spread")
    text = shown(value, "{:.1f} %", 100)
    return f"**{text}**" if value is not None and value > 0.2 else text


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def machines(files):
    head = ["file", "date", "back end", "device", "vectors", "compiler, options", "load before, after", "command"]
    rows = []
    for f in files:
        load = f"{f.facts.get('load average before', '?')}, {f.facts.get('load average after', '?')}"
        compiler = (
            f"{f.facts.get('compiler', '?')}, `{f.facts.get('options', '')}`, Kokkos {f.facts.get('Kokkos', '?')}"
        )
        rows.append([f.name, f.facts.get("date", ""), f.back_end, f.facts.get("device", ""), f.facts.get("vectors", ""),
                     compiler, load, f"`{f.facts.get('command', '')}`"])
    return "## Machines and commands\n\n" + table(head, rows)


KINDS = [
    (m, h, p) for m in ("elastic", "bilinear") for h in ("viscous", "stiffness") for p in ("double", "mixed", "float")
]


def rate_of(results, what, kind):
    rows = results.select(what=what, material=kind[0], hourglass=kind[1], precision=kind[2])
    return number(rows[0], "element_steps_per_second") if rows else None


def side_by_side(files):
    """All back ends in one table: million element-steps a second of the block."""
    head = ["material, hourglass, precision"] + [f"{f.back_end}, {f.facts.get('vectors')}<br>({f.name})" for f in files]
    rows = [
        ["baseline: one at a time, atomics"] + [shown(rate_of(f, "baseline", KINDS[0]), "{:.2f}", 1e-6) for f in files]
    ]
    for kind in KINDS:
        rates = [rate_of(f, "loop", kind) for f in files]
        if any(rates):
            rows.append([", ".join(kind)] + [shown(rate, "{:.2f}", 1e-6) for rate in rates])
    triads = [number(f.select(what="triad")[0], "bytes_per_second") if f.select(what="triad") else None for f in files]
    rows.append(["triad, GB/s"] + [shown(t, "{:.1f}", 1e-9) for t in triads])
    return (
        "## Back ends side by side\n\nMillion element-steps a second, a block of hexahedra. AVX-512, AVX2 and SSE2 are"
        " the same source with packs of 8, 4 and 2 doubles.\n\n"
        + table(head, rows)
    )


def claims(files):
    """The ratios that the project promises, where the results hold them."""
    rows = []
    for f in files:
        base = rate_of(f, "baseline", KINDS[0])
        double = rate_of(f, "loop", ("elastic", "viscous", "double"))
        for label, rate, to in (
            ("elastic viscous double over the baseline", double, base),
            ("mixed over double", rate_of(f, "loop", ("elastic", "viscous", "mixed")), double),
            ("float over double", rate_of(f, "loop", ("elastic", "viscous", "float")), double),
            ("bilinear over elastic, double", rate_of(f, "loop", ("bilinear", "viscous", "double")), double),
        ):
            if rate and to:
                rows.append([label, f.name, shown(rate / to)])
    one = {
        f.facts.get("vectors"): f
        for f in files
        if f.facts.get("threads") == "1" and f.facts.get("back end") == "OpenMP"
    }
    for f in files:
        threads = f.facts.get("threads", "1")
        first = one.get(f.facts.get("vectors"))
        if threads not in ("0", "1") and first:
            a, b = rate_of(f, "loop", KINDS[0]), rate_of(first, "loop", KINDS[0])
            if a and b:
                rows.append([f"{threads} threads over one, elastic viscous double", f.name, shown(a / b)])
    return "## Ratios\n\n" + table(["what", "file", "times"], rows)


def throughput(files):
    text = [
        "## Loop throughput, bytes moved and tasks\n\nBytes: every array that a kernel reads once in, every array that"
        " it writes once out (an ideal cache; `benchmarks/common/traffic.hpp`). Share: of the triad's bandwidth in the"
        " same run. Tasks are timed apart with a fence after each.\n"
    ]
    head = [
        "what", "M element-steps/s", "times baseline", "bytes an element-step", "share of triad",
        "bytes held an element", "spread", "tasks, us a step",
    ]
    for f in files:
        rows = []
        for what in ("baseline", "loop"):
            for row in f.select(what=what):
                kind = {key: row[key] for key in ("material", "hourglass", "precision")}
                tasks = f.select(what="task", **kind) if what == "loop" else []
                parts = ", ".join(
                    f"{s['task'].split(' of ')[0]} {shown(number(s, 'seconds_per_step'), '{:.0f}', 1e6)}"
                    for s in tasks
                )
                rows.append(
                    [
                        f"{what}, " + ", ".join(kind.values()),
                        shown(number(row, "element_steps_per_second"), "{:.2f}", 1e-6),
                        shown(number(row, "times_baseline")),
                        shown(number(row, "bytes_per_element_step"), "{:.0f}"),
                        shown(number(row, "bandwidth_share"), "{:.0f} %", 100),
                        shown(number(row, "device_bytes_per_element"), "{:.0f}"),
                        spread(row),
                        parts,
                    ]
                )
        elements = next((row["elements"] for row in f.rows if row.get("elements")), "?")
        agreement = f.select(what="agreement")
        note = ""
        if agreement:
            note = (
                f" Product and baseline differ by {shown(number(agreement[0], 'difference'), '{:.4f} %', 100)} on a bar"
                f" wave, from the exact one by {shown(number(agreement[0], 'product_error'), '{:.2f} %', 100)} and"
                f" {shown(number(agreement[0], 'baseline_error'), '{:.2f} %', 100)}."
            )
        text.append(
            f"### {f.name}: {f.back_end}\n\n{f.facts.get('device')}, {elements} elements.{note}\n\n" + table(head, rows)
        )
    return "\n".join(text)


def growth(files):
    text = ["## Growth\n"]
    for f in files:
        rows = [[row["precision"], row["elements"], shown(number(row, "seconds_per_step"), "{:.1f}", 1e6),
                 shown(number(row, "element_steps_per_second"), "{:.2f}", 1e-6), spread(row),
                 shown(number(row, "device_bytes_per_element"), "{:.0f}"),
                 shown(number(row, "build_seconds"), "{:.1f}")] for row in f.rows]
        text.append(
            f"### {f.name}: {f.back_end}\n\n"
            + table(
                [
                    "precision", "elements", "us a step", "M element-steps/s", "spread", "bytes an element",
                    "built in, s",
                ],
                rows,
            )
        )
    return "\n".join(text)


def rolling(files):
    text = [
        "## Rolling scene\n\n`cases/rolling.toml` with its element sizes divided: contact, friction, suspension,"
        " torque, gravity; energy account and histories at the outputs. *Of the block* is the rate over that of a block"
        " of as many elements.\n"
    ]
    rows, task_rows = [], []
    for f in files:
        model = (f.select(what="model") or [{}])[0]
        block = f.select(what="block, viscous")
        block_rate = number(block[0], "element_steps_per_second") if block else None
        touching = (f.select(what="contact at the end") or [{}])[0].get("touching", "")
        for row in f.rows:
            if not (row["what"].startswith("run") or row["what"].startswith("loop")):
                continue
            rate = number(row, "element_steps_per_second")
            rows.append([f.name, f.back_end, model.get("precision", ""), row["what"], row["elements"],
                         shown(number(row, "seconds_per_step"), "{:.1f}", 1e6), shown(rate, "{:.2f}", 1e-6),
                         shown(rate / block_rate) if block_rate else "", touching, spread(row)])
        tasks = f.select(what="task")
        whole = sum(number(s, "seconds_per_step") for s in tasks)
        for s in tasks:
            share = number(s, "seconds_per_step")
            task_rows.append([f.name, s["task"], shown(share, "{:.1f}", 1e6), shown(share / whole, "{:.1f} %", 100)])
        text.append(f"- {f.name}: `{model.get('overrides', '').strip() or 'as it is'}`")
    text.append(
        "\n"
        + table(
            [
                "file", "back end", "precision", "what", "elements", "us a step", "M element-steps/s", "of the block",
                "nodes touching", "spread",
            ],
            rows,
        )
    )
    text.append(table(["file", "task, with a fence after it", "us a step", "share"], task_rows))
    return "\n".join(text)


def omissions(files):
    text = [
        "## What leaving things out saves\n\nThe rolling scene, and the same without one thing; below, with an energy"
        " account every so many steps. Savings are of the whole scene's step; what is smaller than the spread is not to"
        " be trusted.\n"
    ]
    for f in files:
        rows = [
            [
                row["what"],
                shown(number(row, "seconds_per_step"), "{:.1f}", 1e6),
                shown(number(row, "saving"), "{:.1f} %", 100),
                spread(row),
            ]
            for row in f.rows
        ]
        elements = next((row["elements"] for row in f.rows if row.get("elements")), "?")
        text.append(
            f"### {f.name}: {f.back_end}, {elements} elements\n\n"
            + table(["scene", "us a step", "saves", "spread"], rows)
        )
    return "\n".join(text)


SECTIONS = {"growth": growth, "rolling": rolling, "omissions": omissions}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", help="folder with the results files (*.csv)")
    parser.add_argument("--out", required=True, help="folder for RESULTS.md and the pictures")
    arguments = parser.parse_args()
    names = sorted(name for name in os.listdir(arguments.results) if name.endswith(".csv"))
    files = [Results(os.path.join(arguments.results, name)) for name in names]
    if not files:
        sys.exit(f"report: error: no results (*.csv) in {arguments.results}; scripts/benchmark makes some")
    by_program = {}
    for f in files:
        by_program.setdefault(f.program, []).append(f)
    parts = [HEAD]
    if "throughput" in by_program:
        group = by_program["throughput"]
        parts += [side_by_side(group), claims(group), throughput(group)]
    parts += [section(by_program[program]) for program, section in SECTIONS.items() if program in by_program]
    if "work_error" in by_program:
        parts.append(report_work_error.section(by_program["work_error"], arguments.out))
    parts.append(machines(files))
    path = os.path.join(arguments.out, "RESULTS.md")
    with open(path + ".new", "w", encoding="utf-8") as file:
        file.write("\n".join(parts))
    os.replace(path + ".new", path)
    print(path)


if __name__ == "__main__":
    main()
