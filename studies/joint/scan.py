"""What the thesis does not print of the joint, varied one by one: which of it moves the frequencies that a hammer finds
(thesis 4.3.2)."""

import dataclasses
import re

import hammer

PLACES = ("rail_end_vertical", "mid_span_vertical", "mid_span_lateral")
# Cheap: each setting is struck three times.
MESH = ["tracks.track.zone_size=0.007", "tracks.track.coarse_size=0.05", "tracks.track.core_size=0.05",
        "tracks.track.section_size=0.012", "tracks.track.web_columns=2", "tracks.track.zone_start=-0.03",
        "time.end=0.02"]


@dataclasses.dataclass
class Setting:
    """What differs from the hammer's case."""

    overrides: list = dataclasses.field(default_factory=list)
    sections: str = ""  # added to the case
    without: str = ""  # lines that begin so are left out
    places: tuple = PLACES

    def case(self, steps, original, name):
        """The original, or a copy with the sections."""
        if not self.sections and not self.without:
            return original
        text = original.read_text(encoding="utf-8")
        if self.without:
            text = re.sub(rf"^(?:{self.without}).*\n", "", text, flags=re.MULTILINE)
        text += self.sections
        path = steps.path(f"{name}.toml")
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
        return path


def timber(line):
    return Setting(sections=f'\n[sleepers.timber]\nbase = "timber"\n{line}\n', places=PLACES[:1])


def pads(length):
    return Setting(sections="".join(f'\n[sleepers.{kind}]\nbase = "{kind}"\npad_length = {length}\n'
                                    for kind in ("timber", "concrete")))


SETTINGS = {
    "as the study has it": Setting(),
    "plates 0.9 m long": Setting(["tracks.track.fishplate_length=0.9"]),
    "plates 10 mm thick": Setting(["tracks.track.fishplate_thickness=0.01"]),
    "plates of 21 GPa": Setting(["tracks.track.fishplate_material=soft"],
                                "\n[materials.soft]\nyoungs_modulus = 21e9\npoissons_ratio = 0.3\ndensity = 7800\n"),
    "no plates: two free ends": Setting(without="fishplates|bolt_pretension"),
    "timber sleepers 0.17 m wide": timber("width = 0.17"),
    "timber sleepers 0.25 m high": timber("height = 0.25"),
    "timber sleepers 2 m long in all": timber("half_length = 1.0"),
    "pads 0.1 m long": pads(0.1),
    "pads 0.22 m long": pads(0.22),
    "timber sleepers 2.2 m long in all": timber("half_length = 1.1"),
    "timber sleepers 2.4 m long in all": timber("half_length = 1.2"),
    "whole track, both rails": Setting(["tracks.track.both_rails=true"]),
    "plates bolted by 12.5 kN, friction 0.3": Setting(
        ["tracks.track.fishplate_fit=contact", "tracks.track.bolt_pretension=12500"],
        '\n[settle]\nmethod = "newton"\ntolerance = 1e-3\n', places=PLACES[:1]),
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
