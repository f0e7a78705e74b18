#!/usr/bin/env python3
"""A small rolling scene in mixed and in single precision against double: scripts/compare_precisions tells the
deviations."""

import importlib.machinery
import importlib.util
import os
import pathlib
import sys

try:
    import h5py  # noqa: F401
except ImportError:
    sys.exit(77)

SOURCE = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"

SMALL = [
    # Not right above the rail's nodes: which of two segments is the nearest would be a matter of rounding.
    "parts.wheel.position=[0.0017, -0.00815, 0.62]", "points.sprung_mass.position=[0.0017, 0, 0.62]",
    "time.end=1e-3", "output.history_interval=1e-5", "output.field_interval=1e-4",
    "meshes.wheel.zone_size=0.006", "meshes.wheel.zone_layers=1", "meshes.wheel.zone_length=0.1",
    "meshes.wheel.coarse_size=0.08", "meshes.wheel.core_size=0.08", "meshes.wheel.section_size=0.012",
    "meshes.rail.zone_size=0.006", "meshes.rail.zone_layers=1", "meshes.rail.zone_end=0.08",
    "meshes.rail.coarse_size=0.08", "meshes.rail.core_size=0.03", "meshes.rail.section_size=0.012",
    "meshes.rail.start=-0.15", "meshes.rail.end=0.2",
]


def load_script():
    loader = importlib.machinery.SourceFileLoader("compare_precisions", str(SOURCE / "scripts" / "compare_precisions"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    sys.dont_write_bytecode = True
    loader.exec_module(module)
    return module


def main():
    script = load_script()
    overrides = [word for override in SMALL for word in ("--set", override)]
    found = script.compare(
        script.parse([str(SOURCE / "cases" / "rolling.toml"), "--program", str(PROGRAM), *overrides])
    )
    script.show(found)
    # The wheel turns by 3.5 degrees and moves by 28 mm; plain displacements in single precision would leave nothing
    # right.
    limits = {"mixed": 1e-4, "float": 1e-3}
    failures = [f"{precision}, {name}: {figures[0]:.2e} is above {limits[precision]:g}"
                for precision, all_figures in found.items() for name, figures in all_figures.items()
                if "balance" not in name and not figures[0] <= limits[precision]]
    failures += [f"{precision}, {name}: {figures[0]:.2e}" for precision, all_figures in found.items()
                 for name, figures in all_figures.items() if "balance" in name and not figures[0] < 1e-3]
    for failure in failures:
        print("FAILED", failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
