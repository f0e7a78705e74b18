"""Rayleigh waves in a mesh of 1 mm by itself: cases/surface_pulse.toml with a shorter blow. A mesh slows short waves
down; so what is found on the rail is to be held against this speed as well."""

import numpy as np

from running_surface import RunningSurface
from spectrum import BANDS, Field, Ridge, Spectrum, rayleigh_speed
from steps import PROJECT

CASE = PROJECT / "cases" / "surface_pulse.toml"
SETTINGS = [
    "meshes.block.divisions=[210, 1, 70]", "parts.block.hourglass=stiffness", "hammers.blow.duration=1.2e-6",
    'output.field_sets=["block.z_max"]', 'output.fields=["velocity"]', "output.field_interval=0.25e-6",
]
FROM, TO = 0.03, 0.14  # m from the blow
CLEAR = 5  # times the median, from which on the pulse's wave is there
HIGHEST = 0.62e6  # Hz: shorter waves than 4 mm are no waves of the steel in that mesh


def run(steps):
    return steps.run("mesh", CASE, SETTINGS)


class MeshWaves:
    """The pulse's wave by frequency."""

    def __init__(self, results):
        surface = RunningSurface(results, "block.z_max")
        # A slice of one element: its two lines of nodes move alike.
        line = np.abs(surface.place[:, 1] - surface.place[:, 1].min()) < 1e-6
        line &= (surface.place[:, 0] > FROM) & (surface.place[:, 0] < TO)
        field = Field(surface.time, surface.place[line], surface.velocity[:, line])
        self.ridge = Ridge(Spectrum(field, piece=surface.time[-1] - surface.time[0]))
        within = (self.ridge.frequency > BANDS[0][0]) & (self.ridge.frequency < HIGHEST)
        self.known = np.flatnonzero(within & (self.ridge.contrast > CLEAR))

    def speed(self, frequency):
        """m/s; nan where the pulse has nothing."""
        at = self.known
        return np.interp(frequency, self.ridge.frequency[at], self.ridge.speed[at], left=np.nan, right=np.nan)


def findings(waves):
    """Rows of the study's table."""
    ridge, rows = waves.ridge, []
    for low, high in BANDS:
        chosen = waves.known[(ridge.frequency[waves.known] > low) & (ridge.frequency[waves.known] < high)]
        if len(chosen):
            speed, _ = ridge.fitted(chosen)
            phase, coherence, ratio = ridge.motion(chosen)
            rows.append((f"Rayleigh waves in a mesh of 1 mm, {1e-6 * low:.1f} to {1e-6 * high:.1f} MHz: speed; phase;"
                         " coherence; ratio", "", f"{1e-3 * speed:.3f} km/s; {phase:.0f} deg; {coherence:.2f};"
                         f" {ratio:.2f}", f"{100 * (speed / rayleigh_speed() - 1):+.1f} %"))
    return rows
