"""Of tables of scripts/contact_pareto: which runs no other beats in both time and error, and the Markdown tables. A
run's worst error is the largest of its errors over the targets that docs/verification.md has for ten elements."""

import csv
import math

from verification.pareto import COLUMNS, DONE, Method, key_of, read_table, time_of

# Targets for ten and for twenty elements over the minor axis.
TARGETS = {
    "peak_pressure_error": (0.04, 0.02), "area_error": (0.06, 0.03), "approach_error": (0.03, 0.015),
    "stick_share_error": (0.10, 0.06), "creepage_error": (0.06, 0.04),
}
SHORT = {"peak_pressure_error": "peak", "area_error": "area", "approach_error": "approach",
         "stick_share_error": "stick", "creepage_error": "creepage", "worst_error": "worst"}
JOINED = [*COLUMNS, "cost", "unit", "worst_error", "worst_error_of_twenty", "front"]


def work_of(row):
    """Element evaluations, of settling and steps: what run time on a processor goes with, whatever the machine. By
    multipliers or springs a step costs the same there within a few per cent (docs/contact.md)."""
    return float(row["elements"]) * (float(row["settling_evaluations"]) + float(row["steps"]))


UNITS = {time_of: "s", work_of: "element evaluations"}


def errors(row):
    """By figure, of those that the scene has."""
    return {name: abs(float(row[name])) for name in TARGETS if row[name] != ""}


def worst(row, which):
    """Largest error over its target; `which` 0: of ten elements, 1: of twenty."""
    return max(size / TARGETS[name][which] for name, size in errors(row).items())


def beaten(point, points):
    """Whether another has no more of either and less of one."""
    return any(q[0] <= point[0] and q[1] <= point[1] and q != point for q in points)


def joined(paths, cost=time_of):
    """Rows of all tables, done ones only, with worst errors and the figures whose front they are on: of runs of the
    same scene and device. Throws ValueError where nothing is there, or where two tables have the same run."""
    rows, seen = [], {}
    for path in paths:
        for row in read_table(path):
            if row["status"] not in DONE:
                continue
            key = (*key_of(row), row["device"])
            if key in seen:
                raise ValueError(f"{path} and {seen[key]} both have {name_of(row)}, {row['elements_across']} elements, "
                                 f"{row['scene']}, on {row['device']}; give the machines names by --device-note")
            if any(not math.isfinite(float(row[name])) for name in ("wall_s", *errors(row))):
                raise ValueError(f"{path}: {name_of(row)}, {row['elements_across']} elements has a number that is none")
            seen[key] = path
            rows.append(row)
    if not rows:
        raise ValueError(f"no run is done in {', '.join(paths)}")
    for row in rows:
        row["worst_error"], row["worst_error_of_twenty"] = worst(row, 0), worst(row, 1)
        row["cost"], row["unit"] = cost(row), UNITS[cost]
    for group in groups(rows).values():
        for row in group:
            mine = {"worst_error": row["worst_error"], **errors(row)}
            row["front"] = " ".join(
                SHORT[name] for name, size in mine.items()
                if not beaten((row["cost"], size), [
                    (r["cost"], {"worst_error": r["worst_error"], **errors(r)}[name]) for r in group])
            )
    return rows


def groups(rows):
    """By scene and device."""
    found = {}
    for row in rows:
        found.setdefault((row["scene"], row["device"]), []).append(row)
    return dict(sorted(found.items()))


def name_of(row):
    return Method(row["algorithm"], float(row["scale"]), row["growth"] == "1").name


def spoken(row):
    if row["algorithm"] == "multiplier":
        return "multipliers"
    return f"penalty, f_SI {float(row['scale']):g}" + (", growth" if row["growth"] == "1" else "")


def order(row):
    return row["algorithm"] == "penalty", row["growth"], float(row["scale"]), int(row["elements_across"])


def write_joined(rows, path):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, JOINED)
        writer.writeheader()
        for row in rows:
            writer.writerow({**row, **{name: f"{row[name]:.4g}" for name in ("worst_error", "worst_error_of_twenty")}})


def cheapest(rows, limit):
    """@param limit name of the worst error that must be at most 1"""
    good = [row for row in rows if row[limit] <= 1]
    return min(good, key=lambda row: row["cost"]) if good else None


def seconds(value):
    return f"{float(value):.3g} s"


def title(group):
    return "time" if group[0]["unit"] == "s" else group[0]["unit"]


def remark(row):
    return "" if row["status"] == "done" else ", not settled"


def spoken_cost(row):
    return seconds(row["cost"]) if row["unit"] == "s" else f"{1e-6 * row['cost']:.3g} M"


def summary(rows):
    """By scene and device, a line for each method: errors and time with ten elements, cheapest runs within targets."""
    lines = []
    for (scene, device), group in groups(rows).items():
        figures = [name for name in TARGETS if any(row[name] != "" for row in group)]
        lines += [f"{scene}, {device}:", "",
                  f"| method | ten elements: {' / '.join(SHORT[name] for name in figures)} | {title(group)} "
                  "| cheapest within targets for ten | for twenty |", "|---|---|---|---|---|"]
        for name in dict.fromkeys(spoken(row) for row in sorted(group, key=order)):
            mine = [row for row in group if spoken(row) == name]
            ten = next((row for row in mine if row["elements_across"] == "10"), None)
            best = [cheapest(mine, limit) for limit in ("worst_error", "worst_error_of_twenty")]
            lines.append(" | ".join([
                f"| {name}",
                " / ".join(f"{100 * float(ten[f]):+.1f}" for f in figures) + " %" if ten else "not run",
                spoken_cost(ten) if ten else "",
                *(f"{spoken_cost(b)}, {b['elements_across']} elements" if b else "none" for b in best),
            ]) + " |")
        lines.append("")
    return lines


def details(rows):
    lines = []
    for (scene, device), group in groups(rows).items():
        figures = [name for name in TARGETS if any(row[name] != "" for row in group)]
        lines += [f"All runs, {scene}, {device}:", "",
                  f"| method | elements across | {title(group)} | settling | step | million element-steps/s | "
                  + " | ".join(SHORT[name] for name in figures) + " | worst over target | on the front of |",
                  "|" + "---|" * (8 + len(figures))]
        for row in sorted(group, key=order):
            lines.append(" | ".join([
                f"| {spoken(row)}", row["elements_across"], spoken_cost(row) + remark(row),
                seconds(row["settling_s"]),
                f"{1e9 * float(row['step_s']):.0f} ns", f"{1e-6 * float(row['element_steps_per_s']):.3g}",
                *(f"{100 * float(row[f]):+.1f} %" for f in figures), f"{row['worst_error']:.2f}", row["front"],
            ]) + " |")
        lines.append("")
    return lines


def markdown(rows):
    return "\n".join(summary(rows) + details(rows))
