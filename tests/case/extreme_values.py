"""Goes over every key of the case file with numbers and texts that nobody means, and judges what `railwave check` says.

The keys come from the program itself (`railwave reference --schema`), so that a new key is tried without a word here;
the scenes below hold an entry of every section and of every type.
"""

import concurrent.futures
import json
import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
from two_blocks import STEEL  # noqa: E402

PROGRAM = os.path.join(os.environ.get("RAILWAVE_BIN_DIR", "build/release/bin"), "railwave")
SECONDS = 60  # of the clock: the machine may be busy with other tests

TIME = """
[time]
end = 1e-4
"""

BLOCKS = STEEL + """
yield_stress = 3e8
tangent_modulus = 1e9
hardening_beta = 0.5
[meshes.block]
type = "box"
size = [0.1, 0.1, 0.1]
divisions = [4, 2, 2]
[seams.crack]
mesh = "block"
place = [0.05, 0.05, 0.1]
length = 0.2
depth = 0.06
angle = 0.0
[parts.lower]
mesh = "block"
material = "steel"
[parts.upper]
mesh = "block"
material = "steel"
position = [0, 0, 0.1001]
[parts.tied]
mesh = "block"
material = "steel"
position = [0, 0.1, 0]
[parts.driven]
mesh = "block"
material = "steel"
position = [1, 0, 0]
[points.mass]
mass = 10
position = [0.05, 0.05, 0.3]
[points.far]
mass = 1
position = [0.5, 0.05, 0.3]
[node_sets.corner]
part = "upper"
position = [0, 0, 0.2]
radius = 0.01
[node_sets.boxed]
part = "upper"
box = [[-1, -1, 0.19], [1, 1, 1]]
[beams.bolt]
from = "mass"
to = "far"
material = "steel"
section = "circle"
radius = 0.01
[beams.bar]
from = "mass"
to = "far"
material = "steel"
section = "rectangle"
width = 0.01
height = 0.02
[connectors.spring]
from = "mass"
to = "upper.z_max"
stiffness = [0, 0, 1e6]
damping = [0, 0, 1e3]
[connectors.bed]
from = "ground"
to = "lower.z_min"
stiffness = [0, 0, 1e6]
spread = [2, 2]
area = [[0, 0, -1], [0.1, 0.1, 1]]
[constraints.floor]
target = "lower.x_min"
fixed = ["y"]
[contacts.between]
slave = "upper.z_min"
master = "lower.z_max"
friction = 0.3
dynamic_friction = 0.2
friction_decay = 1
penalty_growth = [[0, 1], [1e-5, 2]]
close_gap = [0, 0, -1]
[ties.sides]
slave = "tied.y_min"
master = "lower.y_max"
[curves.ramp]
type = "cosine_ramp"
start = 0
duration = 1e-4
[curves.blow]
type = "half_sine"
start = 0
duration = 1e-4
[curves.table]
type = "table"
points = [[0, 0], [1e-4, 1]]
[curves.flat]
type = "constant"
[loads.push]
type = "nodal_force"
target = "upper.z_max"
force = [0, 0, -1]
curve = "ramp"
[loads.press]
type = "pressure"
target = "upper.x_max"
pressure = 1e3
[loads.drag]
type = "traction"
target = "upper.y_max"
traction = [1e3, 0, 0]
[loads.twist]
type = "torque"
target = "lower.x_max"
moment = 1
axis = [1, 0, 0]
[hammers.tap]
part = "tied"
position = [0.1, 0.2, 0.1]
peak = 100
duration = 1e-4
[probes.row]
part = "tied"
position = [0, 0.2, 0.1]
count = 2
spacing = [0.05, 0, 0]
[gravity]
acceleration = [0, 0, -9.81]
[initial_motion.fall]
parts = ["upper"]
velocity = [0, 0, -1]
angular_velocity = [0, 0, 1]
centre = [0, 0, 0]
[prescribed_motion.drive]
target = "driven.x_min"
velocity = [0, 0, 0]
angular_velocity = [1, 0, 0]
centre = [0, 0, 0]
displacement = [0, 0, 1e-6]
displacement_curve = "ramp"
[non_reflecting.end]
target = "driven.x_max"
[absorbing_layers.end]
target = "driven.x_max"
length = 0.06
reflection = 0.02
[settle]
active = false
[checkpoint]
interval = 60
[solver]
[monitor]
[output]
history_interval = 1e-5
field_interval = 1e-4
""" + TIME


def one_mesh(text, sections=""):
    return STEEL + f"[meshes.body]\n{text}\n[parts.body]\nmesh = \"body\"\nmaterial = \"steel\"\n" + sections + TIME


WHEEL = (
    "zone_size = 0.008\nzone_width = 0.024\nzone_length = 0.1\nzone_start = -0.05\nzone_layers = 1\n"
    "path_start = -0.3\npath_size = 0.01\nsection_size = 0.012\ncore_size = 0.09"
)
RAIL = (
    "zone_size = 0.004\nzone_width = 0.024\nzone_layers = 2\npath_start = -0.1\npath_end = 0.2\npath_size = 0.01\n"
    "section_size = 0.01\ninclination = 0.0\nzone_centre = 0.0"
)
FILE_MESH = """*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
*ELEMENT, TYPE=C3D8R, ELSET=all
1, 1, 2, 3, 4, 5, 6, 7, 8
"""
HEIGHTS = "x,y,dz\n" + "".join(f"{x},{y},1e-6\n" for x in (-0.1, 0.2) for y in (-0.02, 0.02))

# Of a track's rail the track itself says where zone and path lie.
TRACK_RAIL = RAIL
for line in ("zone_centre = 0.0", "path_start = -0.1", "path_end = 0.2", "path_size = 0.01"):
    TRACK_RAIL = TRACK_RAIL.replace(line, "")

SCENES = {
    "blocks": BLOCKS,
    "wheel": one_mesh(f'type = "wheel"\n{WHEEL}'),
    "cone": one_mesh(f'type = "wheel"\nprofile = "cone"\nconicity = 0.03\n{WHEEL}'),
    "rail": one_mesh(f'type = "rail"\n{RAIL}\nheight_map = "heights.csv"\nheight_map_depth = 0.01'),
    "crowned_block": one_mesh('type = "crowned_block"\nzone_size = 0.005\nradius_along = 0.5\nradius_across = 0.5'),
    "roller": one_mesh('type = "roller"\nzone_size = 0.005\ncrown_radius = 1'),
    "ring": one_mesh('type = "ring"\nround_divisions = 24'),
    "cylinder": one_mesh('type = "cylinder"\nlength_divisions = 4'),
    "file": one_mesh('type = "file"\npath = "cube.inp"'),
    "wheelset": one_mesh(f'type = "wheelset"\nhalf = true\n{WHEEL}'),
    "plate": one_mesh(
        f'type = "rail"\n{RAIL}',
        '[meshes.plate]\ntype = "fishplate"\nrail = "body"\nstart = -0.1\nend = 0.1\ngap_start = -0.01\n'
        'gap_end = 0.01\n[parts.plate]\nmesh = "plate"\nmaterial = "steel"\n[meshes.pad]\ntype = "rail_pad"\n'
        'rail = "body"\n[parts.pad]\nmesh = "pad"\nmaterial = "steel"\n',
    ),
    "track": (
        STEEL
        + f"""
[sleepers.own]
divisions = [2, 4, 1]
pad = "solid"
[sleepers.other]
divisions = [2, 4, 1]
[tracks.track]
start = -0.9
end = 0.9
sleeper = "own"
other_sleeper = "other"
other_positions = [0.88]
first_sleeper = -0.6
gap_position = 0.0
gap = 0.008
fishplates = true
zone_start = -0.02
zone_end = 0.03
{TRACK_RAIL}
coarse_size = 0.1
core_size = 0.1
"""
        + TIME
    ),
}

NUMBERS = [
    "0", "-0.0", "1e-300", "-1e-300", "1e300", "-1e300", "nan", "inf", "-1", "1", "1e9", "1e-9", "9223372036854775807",
]
TEXTS = ['""', '"-"', '"../x"', '"a/b"', '"' + "x" * 300 + '"', '"\\u0007"', '"é ñ"']


def schema():
    return json.loads(
        subprocess.run([PROGRAM, "reference", "--schema"], capture_output=True, check=True, text=True).stdout
    )


def entries(scene_text):
    """(section, entry name or None, type or None) of what a scene has."""
    import tomllib
    scene = tomllib.loads(scene_text)
    for section, content in scene.items():
        if section in ("time", "settle", "checkpoint", "solver", "monitor", "output", "gravity"):
            yield section, None, content
        else:
            for name, entry in content.items():
                yield section, name, entry


def keys_of(document, section, entry):
    """name -> schema of each key that the entry may have."""
    found = document["properties"][section]
    if "additionalProperties" in found and isinstance(found["additionalProperties"], dict):
        found = found["additionalProperties"]
    for one in found.get("oneOf", [found]):
        kind = one["properties"].get("type", {}).get("const")
        if kind is None or kind == entry.get("type"):
            return one["properties"]
    raise KeyError((section, entry))


def values_of(key, numbers, texts):
    """TOML of every value to be tried for a key of that schema."""
    kind = key.get("type")
    if kind in ("number", "integer"):
        return numbers
    if kind == "array":
        items = key["items"]
        if "prefixItems" in items:
            return [f"[[0, 1], [{v}, 1]]" for v in numbers] + [f"[[0, 1], [1, {v}]]" for v in numbers] + ["[]"]
        count = key.get("minItems", 1)
        inner = values_of(items, numbers, texts)
        return ["[" + ", ".join([v] * count) + "]" for v in inner] + ["[]"]
    if kind == "string" and "enum" not in key:
        return texts
    return []


def trials(numbers=tuple(NUMBERS), texts=tuple(TEXTS), scenes=None):
    """(scene's name, 'section.name.key', value): everything once; what several entries have alike, in the first of
    them."""
    document, tried = schema(), set()
    for scene, text in (scenes or SCENES).items():
        for section, name, entry in entries(text):
            for key, about in keys_of(document, section, entry).items():
                if key == "type" or (section, entry.get("type"), key) in tried:
                    continue
                tried.add((section, entry.get("type"), key))
                place = ".".join(part for part in (section, name, key) if part)
                for value in values_of(about, list(numbers), list(texts)):
                    yield scene, place, value


def write_scenes(folder, scenes=None):
    for name, text in (scenes or SCENES).items():
        with open(os.path.join(folder, name + ".toml"), "w", encoding="utf-8") as file:
            file.write(text)
    with open(os.path.join(folder, "cube.inp"), "w", encoding="utf-8") as file:
        file.write(FILE_MESH)
    with open(os.path.join(folder, "heights.csv"), "w", encoding="utf-8") as file:
        file.write(HEIGHTS)


def say(folder, scene, *sets, command="check", more=()):
    """Exit code, standard output and error of a command on a scene with overrides; the exit code is None where it takes
    too long."""
    words = [PROGRAM, command, scene + ".toml"] + [word for one in sets for word in ("--set", one)] + list(more)
    try:
        done = subprocess.run(words, cwd=folder, capture_output=True, timeout=SECONDS, stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired as late:
        return None, "", (late.stderr or b"").decode(errors="replace")
    return done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")


def faults_of(place, value, code, out, err):
    """What is wrong with an answer, each a sentence; none when it is as it should be."""
    faults = []
    if code not in (0, 2, 3):
        faults.append(f"exit code {code}")
    given = re.search(r"nan|inf", value)
    said = err if code != 0 else out + err
    if not given and re.search(r"(?<![\w.])-?(inf|nan)(?![\w])", said):
        faults.append("says inf or nan")
    if re.search(r"\d{40}", said):
        faults.append("prints a number of 40 digits or more")
    if code == 2:
        if max(map(len, err.splitlines() or [""])) > 600:
            faults.append("a message of more than 600 characters")
        words = place.split(".")
        # Many steps, or outputs, may come of any key: what sets the step is reported instead.
        derived = "the step is set by" in err or "see whether the step is" in err
        if words[-1] not in err and not (len(words) == 3 and words[1] in err) and not derived:
            faults.append("names neither the key nor the entry")
        if not err.strip():
            faults.append("says nothing")
    return faults


def sweep(folder, wanted, workers=2):
    """All faults of the trials, as texts."""
    write_scenes(folder)

    def judge(trial):
        scene, place, value = trial
        code, out, err = say(folder, scene, f"{place}={value}")
        faults = faults_of(place, value, code, out, err)
        return f"{scene}: {place}={value[:60]}: {'; '.join(faults)}: {err[:700]}" if faults else None

    with concurrent.futures.ThreadPoolExecutor(workers) as pool:
        return [fault for fault in pool.map(judge, wanted) if fault]
