"""What the thesis does not print of the joint, varied one by one: which of it moves the frequencies that a hammer finds
(thesis 4.3.2)."""

import dataclasses
import re

import hammer

PLACES = ("rail_end_vertical", "mid_span_vertical", "mid_span_lateral")
# Cheap: each setting is struck three times.
MESH = [*hammer.COARSE, "tracks.track.zone_size=0.007", "tracks.track.coarse_size=0.05", "tracks.track.core_size=0.05"]


@dataclasses.dataclass
class Setting:
    """What differs from the hammer's case."""

    lines: dict = dataclasses.field(default_factory=dict)  # by the key that begins a line of the case, what it becomes
    sections: str = ""  # added
    overrides: list = dataclasses.field(default_factory=list)
    places: tuple = PLACES

    def case(self, steps, original, name):
        """The case so changed."""
        text = original.read_text(encoding="utf-8")
        for key, line in self.lines.items():
            text, count = re.subn(rf"^{key} = .*\n", line and f"{line}\n", text, flags=re.MULTILINE)
            if count != 1:
                raise ValueError(f"{original} has {count} lines of {key}")
        return steps.write_case(name, text + self.sections)


STIFF = {"fishplate_material": ""}  # plates of the rail's steel, and the default timber
DEFAULTS = {**STIFF, "height": ""}


def stiff(*overrides):
    return Setting(DEFAULTS, overrides=list(overrides))


def timber(line):
    return Setting({**STIFF, "height": line}, places=PLACES[:1])


def pads(length):
    return Setting({**STIFF, "height": f"pad_length = {length}"},
                   f'\n[sleepers.concrete]\nbase = "concrete"\npad_length = {length}\n')


SETTINGS = {
    "as the study has it": Setting(),
    "defaults": stiff(),
    "plates 0.9 m long": stiff("tracks.track.fishplate_length=0.9"),
    "plates 10 mm thick": stiff("tracks.track.fishplate_thickness=0.01"),
    "plates of 21 GPa": Setting({"height": ""}, overrides=["materials.plates.youngs_modulus=21e9"]),
    "no plates: two free ends": Setting({**DEFAULTS, "fishplates": "", "bolt_pretension": ""}),
    "timber sleepers 0.17 m wide": timber("width = 0.17"),
    "timber sleepers 2 m long in all": timber("half_length = 1.0"),
    "timber sleepers 2.2 m long in all": timber("half_length = 1.1"),
    "timber sleepers 2.4 m long in all": timber("half_length = 1.2"),
    "timber sleepers 0.25 m high": timber("height = 0.25"),
    "timber sleepers 0.13 m high": timber("height = 0.13"),
    "timber sleepers 0.11 m high": timber("height = 0.11"),
    "timber sleepers 0.11 m high, plates of 21 GPa": Setting(overrides=["materials.plates.youngs_modulus=21e9"]),
    "timber sleepers 0.11 m high, plates bolted by 12.5 kN": Setting(
        {**STIFF, "bolt_pretension": "bolt_pretension = 12500"},
        '\n[settle]\nmethod = "newton"\ntolerance = 1e-3\n', ["tracks.track.fishplate_fit=contact"], PLACES[:1]),
    "pads 0.1 m long": pads(0.1),
    "pads 0.22 m long": pads(0.22),
}


def scan(steps, case):
    """A row for each setting: its name and what hammer.findings has."""
    rows = []
    for number, (name, setting) in enumerate(SETTINGS.items()):
        print(f"-- {name}", flush=True)
        prefix = f"scan_{number}_"
        own = setting.case(steps, case, f"scan_{number}")
        tables = hammer.strike(steps, own, [*setting.overrides, *MESH], setting.places, prefix)
        rows.append((name, hammer.findings(tables)))
    return rows
