#!/usr/bin/env python3
"""Every dataset of every kind of file that the program writes says its unit."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
except ImportError:
    sys.exit(77)

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from two_blocks import STEEL as ELASTIC_STEEL, two_blocks  # noqa: E402

STEEL = ELASTIC_STEEL + """\
yield_stress = 4e8
tangent_modulus = 2e9
"""

# One block falls on another; a spring, beams, loads and a row of probes besides: all that a results file may hold.
BLOCKS = two_blocks(
    ([0.06, 0.05, 0.03], [6, 5, 3]), ([0.04, 0.04, 0.03], [4, 4, 3]), [0.005, 0.005, 0.03001], STEEL
) + """\
friction_decay = 0.5
dynamic_friction = 0.1
[points.hub]
mass = 0.5
position = [0.025, 0.025, 0.075]
[beams.spokes]
from = "hub"
to = "upper.z_max"
material = "steel"
radius = 0.004
count = 4
orientation = [0, 0, 1]
[connectors.spring]
from = "ground"
to = "hub"
stiffness = [1e6, 1e6, 1e6]
damping = [100, 100, 100]
[loads.turn]
type = "torque"
target = "upper.x_max"
moment = 3
[loads.press]
type = "pressure"
target = "upper.x_min"
pressure = 2e6
[hammers.blow]
part = "lower"
position = [0.06, 0.025, 0.015]
direction = [-1, 0, 0]
peak = 100
duration = 5e-5
[probes.row]
part = "lower"
position = [0.005, 0.025, 0.015]
count = 5
spacing = [0.0125, 0, 0]
quantities = ["displacement", "velocity", "acceleration", "stress", "strain", "plastic_strain"]
[element_sets.core]
part = "lower"
box = [[0.01, 0.01, 0], [0.05, 0.04, 0.02]]
[initial_motion.fall]
parts = ["upper", "hub"]
velocity = [2, 0, -5]
[time]
end = 4e-4
[output]
file = "results.h5"
history_interval = 1e-6
field_interval = 2e-5
field_sets = ["upper", "lower.core", "lower.z_max"]
fields = ["displacement", "velocity", "acceleration", "stress", "plastic_strain"]
history_sets = ["hub", "lower.core"]
"""

# Units of what stands in these places; everything else must have some.
KNOWN = {
    "history/time": "s", "history/energy/damping": "J", "history/energy/balance_error": "J",
    "history/set/lower.row_2/stress": "Pa",
    "history/set/lower.row_2/strain": "1", "history/set/lower.row_2/element_centre": "m",
    "history/set/hub/acceleration": "m/s2",
    "history/load/turn/moment": "N m", "history/load/press/force": "N", "history/beam/spokes/moment": "N m",
    "history/contact/between/nodes_slipping": "1",
    "fields/upper/stress": "Pa", "fields/upper/plastic_strain": "1", "fields/upper/connectivity": "1",
    "fields/lower.z_max/velocity": "m/s",
    "beams/spokes/force": "N", "contact/between/slave/area": "m2", "contact/between/master/shear": "Pa",
    "contact/between/slave/friction": "1",
    "contact/between/slave/gap": "m", "contact/between/step": "1",
}


class Units(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        cls.folder = pathlib.Path(cls.temporary.name)
        (cls.folder / "case.toml").write_text(BLOCKS)
        cls.railwave("run", "case.toml")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def railwave(cls, *words, code=0):
        done = subprocess.run([PROGRAM, *map(str, words)], cwd=cls.folder, capture_output=True, text=True, timeout=300)
        assert done.returncode == code, done.stdout + done.stderr

    def units(self, name):
        """Units of all datasets of a file; each must have one."""
        found, without = {}, []

        def look(path, item):
            if not isinstance(item, h5py.Dataset):
                return
            found[path] = item.attrs.get("unit")
            if not isinstance(found[path], str) or not found[path].strip():
                without.append(path)

        with h5py.File(self.folder / name, "r") as file:
            file.visititems(look)
        self.assertTrue(found, name)
        self.assertEqual(without, [], name)
        return found

    def test_results(self):
        units = self.units("results.h5")
        self.assertEqual({name: units.get(name) for name in KNOWN}, KNOWN)

    def test_model(self):
        self.railwave("mesh", "case.toml", "--out", "model.h5")
        units = self.units("model.h5")
        self.assertIn("element_sets/lower.core/connectivity", units)
        self.assertIn("element_sets/lower.row_3/coordinates", units)
        self.assertEqual(
            [
                units[name]
                for name in (
                    "parts/upper/coordinates",
                    "parts/upper/stable_step",
                    "connectors/damping",
                    "beams/pretension",
                )
            ],
            ["m", "s", "N s/m", "N"],
        )

    def test_modes(self):
        (self.folder / "alone.toml").write_text(STEEL + """
[meshes.bar]
type = "box"
size = [0.2, 0.02, 0.03]
divisions = [10, 2, 2]
[parts.bar]
mesh = "bar"
material = "steel"
[time]
end = 1e-5
""")
        self.railwave("modes", "alone.toml", "--up-to", 3000, "--out", "modes.h5")
        units = self.units("modes.h5")
        self.assertEqual(
            [units[name] for name in ("modes/frequency", "modes/modal_mass", "fields/bar/displacement")],
            ["Hz", "kg", "1"],
        )

    def test_contact(self):
        self.railwave("contact", "results.h5", "--hdf5", "contact.h5")
        units = self.units("contact.h5")
        self.assertEqual(
            [
                units[f"contact/between/{name}"]
                for name in ("patches/area", "nodes/row", "nodes/pressure", "facets/area")
            ],
            ["m2", "1", "Pa", "m2"],
        )

    def test_signals(self):
        one = ("--channel", "lower.row_1.velocity.x")
        two = (*one, "--channel", "lower.row_2.velocity.x")
        band = ("--low", 20e3, "--high", 200e3)
        for kind, words in (
            ("psd", (*one, "--channel", "lower.row_1.stress.xx")),
            ("wavelet", (*one, *band)),
            ("bandpass", (*one, *band)),
            ("cross", two),
            ("ellipse", two),
            ("speed", ("--channel", "lower.row_*.velocity.x", *band)),
        ):
            self.railwave("signal", kind, "results.h5", *words, "--hdf5", f"{kind}.h5")
            self.units(f"{kind}.h5")

    def test_hammer(self):
        self.railwave("frf", "results.h5", "--hdf5", "frf.h5")
        self.assertIn("m/s2/N", " ".join(self.units("frf.h5").values()))

    def test_decay(self):
        (self.folder / "bar.toml").write_text(STEEL + """
[meshes.bar]
type = "box"
size = [1.0, 0.02, 0.02]
divisions = [50, 1, 1]
[parts.bar]
mesh = "bar"
material = "steel"
[hammers.blow]
part = "bar"
position = [0.1, 0.01, 0.02]
direction = [0, 0, -1]
peak = 100
duration = 1e-4
[probes.row]
part = "bar"
position = [0.2, 0.01, 0.02]
count = 7
spacing = [0.1, 0, 0]
[time]
end = 2e-3
[output]
file = "bar.h5"
history_interval = 5e-6
""")
        self.railwave("run", "bar.toml")
        self.railwave("decay", "bar.h5", "--hdf5", "decay.h5", "--from", 1000, "--to", 4000)
        units = self.units("decay.h5")
        self.assertEqual((units["decay_rate"], units["level"], units["distance"]), ("dB/m", "dB", "m"))

    def test_fault(self):
        self.railwave(
            "run", "case.toml", "--set", "output.file=broken.h5", "--set", "monitor.speed=1", "--set",
            "monitor.fatal_speed=4", code=3,
        )
        units = self.units("broken.fault.h5")
        self.assertEqual(
            [units[f"parts/upper/{name}"] for name in ("stress", "displacement", "culprit")], ["Pa", "m", "1"]
        )
        self.units("broken.h5")


if __name__ == "__main__":
    unittest.main()
