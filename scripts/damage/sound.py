"""Small sound results files for the fuzzer of their readers, and the commands that read them."""

import pathlib
import shutil
import subprocess

import h5py

STEEL = """
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
"""
CONTACT = STEEL + """
[meshes.lower]
type = "box"
size = [0.03, 0.03, 0.02]
divisions = [3, 3, 2]
[meshes.upper]
type = "box"
size = [0.02, 0.02, 0.02]
divisions = [2, 2, 2]
[parts.lower]
mesh = "lower"
material = "steel"
[parts.upper]
mesh = "upper"
material = "steel"
position = [0.005, 0.005, 0.02001]
[constraints.floor]
target = "lower.z_min"
fixed = ["x", "y", "z"]
[contacts.between]
slave = "upper.z_min"
master = "lower.z_max"
friction = 0.3
symmetric = {symmetric}
[initial_motion.fall]
parts = ["upper"]
velocity = [2, 1, -12]
[time]
end = 6e-5
[output]
history_interval = 1e-6
field_interval = 1e-5
field_sets = ["upper"]
history_sets = ["upper.z_max", "upper.z_min"]
fields = ["displacement", "stress"]
"""
HAMMER = STEEL + """
[meshes.bar]
type = "box"
size = [1, 0.02, 0.02]
divisions = [50, 1, 1]
[parts.bar]
mesh = "bar"
material = "steel"
[hammers.blow]
part = "bar"
position = [0, 0.01, 0.02]
radius = 0.015
direction = [0, 0, -1]
peak = 100
duration = 1e-4
[probes.row]
part = "bar"
position = [0.1, 0.01, 0.02]
count = 5
spacing = [0.15, 0, 0]
[points.end]
mass = 0.01
position = [1.2, 0.01, 0.01]
[beams.rod]
from = "end"
to = "bar.x_max"
material = "steel"
radius = 0.01
divisions = 4
[time]
end = 1.2e-3
[output]
history_interval = 4e-6
field_interval = 4e-4
field_sets = ["bar"]
fields = ["velocity"]
"""


# Follows [output], with which CONTACT ends: nodes near the contact only; areas and normals are to be found.
NEAR = """contact_margin = 0.012
contact_fields = ["displacement", "velocity", "normal_force", "tangential_force", "slip_velocity", "slipping"]
precision = "single"
"""


class Seed:
    """A sound file; `commands`: {name: words}, in which FILE is the damaged file and OUT a folder for what is
    written."""

    def __init__(self, name, path, commands, checked=True):
        self.name, self.path, self.commands, self.checked = name, pathlib.Path(path), commands, checked
        self.beside = []  # files that the commands need beside it
        self.bytes = self.path.read_bytes()


def old_format(path, copy):
    """The same as the program wrote it before it had checksums: other chunks, HDF5's oldest formats."""
    with h5py.File(path, "r") as source, h5py.File(copy, "w") as target:
        def take(name, item):
            if isinstance(item, h5py.Dataset):
                grows = item.maxshape and item.maxshape[0] is None
                made = target.create_dataset(
                    name, data=item[()], chunks=item.chunks if grows else None,
                    maxshape=item.maxshape if grows else None, compression="gzip" if item.compression_opts else None,
                    shuffle=bool(item.compression_opts),
                )
            else:
                made = target.require_group(name)
            for key, value in item.attrs.items():
                made.attrs[key] = value
        source.visititems(take)
        for key, value in source.attrs.items():
            target.attrs[key] = value


def run(program, folder, name, text, *options):
    case = folder / f"{name}.toml"
    case.write_text(text)
    done = subprocess.run(
        [program, "run", case.name, "--set", f"output.file={name}.h5", *options],
        cwd=folder, capture_output=True, text=True, check=False,
    )
    if done.returncode != 0:
        raise SystemExit(f"{case} did not run\n{done.stdout}{done.stderr}")
    return folder / f"{name}.h5"


CONTACT_COMMANDS = {
    "contact": "contact FILE --csv OUT/t.csv --nodes OUT/n.csv --cuts OUT/c.csv",
    "contact --hdf5": "contact FILE --hdf5 OUT/c.h5 --axle upper.z_max",
    "report": "report FILE --out OUT/r.html",
    "export": "export FILE --vtkhdf --out OUT/e.vtkhdf",
    "signal psd": "signal psd FILE --channel contact.between.normal_force.size --csv OUT/p.csv",
    "signal bandpass": "signal bandpass FILE --channel energy.kinetic --low 1e4 --csv OUT/p.csv --hdf5 OUT/p.h5",
}
HAMMER_COMMANDS = {
    "frf": "frf FILE --csv OUT/f.csv --hdf5 OUT/f.h5",
    "report": "report FILE --out OUT/r.html",
    "decay": "decay FILE --from 1000 --to 20000 --csv OUT/d.csv",
    "signal psd": "signal psd FILE --channel bar.row_*.velocity.z --csv OUT/p.csv",
    "signal wavelet": "signal wavelet FILE --channel bar.row_2.velocity.z --csv OUT/w.csv",
    "signal bandpass": "signal bandpass FILE --channel load.blow.force.z --high 2e4 --csv OUT/b.csv",
    "signal cross": "signal cross FILE --channel load.blow.force.z --channel bar.row_1.acceleration.z --csv OUT/x.csv",
    "signal ellipse": (
        "signal ellipse FILE --channel bar.row_1.displacement.z --channel bar.row_1.displacement.x --csv OUT/e.csv"
    ),
    "signal speed": "signal speed FILE --channel bar.row_*.velocity.z --csv OUT/s.csv",
    "signal beam": "signal psd FILE --channel beam.rod.moment.1.y --csv OUT/p.csv",
}


def without_report(program, commands):
    """Those that work where the page of reports has not been made."""
    build = pathlib.Path(program).resolve().parent.parent
    there = (build / "share/railwave/report.html").exists() or (build.parent / "report/report.html").exists()
    return {name: words for name, words in commands.items() if there or name != "report"}


def make(program, folder):
    """Makes all sound files in a folder; returns the seeds."""
    folder.mkdir(parents=True, exist_ok=True)
    seeds = []
    of_contact, of_hammer = without_report(program, CONTACT_COMMANDS), without_report(program, HAMMER_COMMANDS)
    for name, symmetric in (("contact", "false"), ("symmetric", "true")):
        path = run(program, folder, name, CONTACT.format(symmetric=symmetric))
        seeds.append(Seed(name, path, of_contact))
    near = run(program, folder, "near", CONTACT.format(symmetric="false") + NEAR)
    seeds.append(Seed("near", near, of_contact))
    hammer = run(program, folder, "hammer", HAMMER)
    seeds.append(Seed("hammer", hammer, of_hammer))
    for name, commands in (("contact", of_contact), ("hammer", of_hammer)):
        old_format(folder / f"{name}.h5", folder / f"{name}-old.h5")
        seeds.append(Seed(f"{name}, old format", folder / f"{name}-old.h5", commands, checked=False))
    # A run that can be gone on with: its results or its checkpoint are damaged.
    going = folder / "going"
    going.mkdir(exist_ok=True)
    results = run(program, going, "results", CONTACT.format(symmetric="false"), "--keep-state")
    case, checkpoint = going / "results.toml", going / "results.checkpoint.h5"
    words = {"run --restart": "run results.toml --restart --set output.file=results.h5 --set time.end=9e-5"}
    for name, path, others in (("restart", results, [checkpoint]), ("checkpoint", checkpoint, [results])):
        seed = Seed(name, path, words)
        seed.beside = [case, *others]
        seeds.append(seed)
    shutil.copy(results, folder / "restart.h5")
    return seeds
