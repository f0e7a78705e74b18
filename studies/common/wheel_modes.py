"""Modes of the wheel with its hub held at the bore (thesis 4.3.5), beside what the thesis calculates."""

from steps import PROJECT, rows_of

CASE = PROJECT / "cases" / "wheel_modes.toml"
AXIAL = ((0, 183), (3, 1075), (4, 1934))  # nodal diameters of axial modes without nodal circle, Hz


def table(steps, coarse):
    """The table of modes, to 10 kHz."""
    path = steps.path("modes.csv")
    words = [steps.program, "modes", CASE, "--up-to", 2500 if coarse else 10000, "--csv", path, "--overwrite"]
    if coarse:
        for size in ("zone_size=0.01", "coarse_size=0.05", "core_size=0.05", "web_columns=2"):
            words += ["--set", f"meshes.wheel.{size}"]
    steps.once("modes", [CASE], words, lambda: steps.command(*words))
    return rows_of(path)


def axial(listed, diameters):
    """Frequency of the axial mode without nodal circle, Hz; None: it is not in the table."""
    wanted = "axial", "0", str(diameters)
    return min((float(row["frequency"]) for row in listed
                if (row["kind"], row["nodal_circles"], row["nodal_diameters"]) == wanted), default=None)


def rows(listed):
    """(what, thesis, thesis, found), Hz, of the axial modes that the thesis names."""
    return [(f"wheel, bore held: axial mode (0,{diameters})", simulated, simulated, axial(listed, diameters))
            for diameters, simulated in AXIAL]
