"""What the thesis does not print of the joint, varied one by one: which of it moves the frequencies that a hammer finds
(thesis 4.3.2)."""

import hammer

PLACES = ("rail_end_vertical", "mid_span_vertical", "mid_span_lateral")
WITHOUT_PLATES = ["tracks.track.fishplates=false"]
BOLTED = ["tracks.track.fishplate_fit=contact", "tracks.track.bolt_pretension=12500", "settle.method=newton",
          "settle.tolerance=1e-3"]
SOFT = ["materials.soft.youngs_modulus=21e9", "materials.soft.poissons_ratio=0.3", "materials.soft.density=7800",
        "tracks.track.fishplate_material=soft"]
# Name: what is set, and where is struck.
SETTINGS = {
    "as the study has it": ([], PLACES),
    "plates 0.9 m long": (["tracks.track.fishplate_length=0.9"], PLACES),
    "plates 10 mm thick": (["tracks.track.fishplate_thickness=0.01"], PLACES),
    "plates of 21 GPa": (SOFT, PLACES),
    "plates bolted by 12.5 kN, friction 0.3": (BOLTED, PLACES[:1]),
    "no plates: two free ends": (WITHOUT_PLATES, PLACES),
    "timber sleepers 0.15 m wide": (["sleepers.timber.width=0.15"], PLACES),
    "timber sleepers 0.25 m high": (["sleepers.timber.height=0.25"], PLACES),
    "timber sleepers 2 m long in all": (["sleepers.timber.half_length=1.0"], PLACES),
    "pads 0.1 m long": (["sleepers.timber.pad_length=0.1", "sleepers.concrete.pad_length=0.1"], PLACES),
    "pads 0.22 m long": (["sleepers.timber.pad_length=0.22", "sleepers.concrete.pad_length=0.22"], PLACES),
    "whole track, both rails": (["tracks.track.both_rails=true"], PLACES),
}


# Cheap: each setting is struck three times.
MESH = ["tracks.track.zone_size=0.007", "tracks.track.coarse_size=0.05", "tracks.track.core_size=0.05",
        "tracks.track.section_size=0.012", "tracks.track.web_columns=2", "tracks.track.zone_start=-0.03",
        "time.end=0.02"]


def scan(steps, case):
    """A row for each setting: its name and what hammer.findings has."""
    rows = []
    for number, (name, (settings, places)) in enumerate(SETTINGS.items()):
        print(f"-- {name}", flush=True)
        tables = hammer.strike(steps, case, [*settings, *MESH], places, f"scan_{number}_")
        rows.append((name, hammer.findings(tables)))
    return rows
