"""The runs of the study: cases 1 and 4 of the squeal's study with outputs of the running surface and of the contact in
short windows, one under braking, one with a crack."""

import dataclasses
import pathlib

import cases
import reduced

HERE = pathlib.Path(__file__).resolve().parent
SPEED = 27.78  # m/s
OUTPUT = [
    'output.field_sets=["track_rail.waves"]', 'output.fields=["velocity"]', 'output.contact_sides=["slave"]',
    'output.contact_fields=["displacement","normal_force","tangential_force","slip_velocity"]',
    "output_windows.solutions.field_sets=[]",
]


@dataclasses.dataclass(frozen=True)
class Scene:
    """Times and places are those of the whole way."""

    case: int
    window: tuple  # s, of the surface's outputs
    interval: float  # s, between these
    surface: tuple  # m, along the rail, from where the wheel began
    contact: tuple  # s, of the contact's outputs
    contact_interval: float
    braking: bool = False  # the squeal study's torque the other way round
    crack: bool = False
    tangential: bool = True  # whether the reduced data have it at all nodes of the surface

    def overrides(self, extent):
        """What it changes in the squeal's case."""
        earlier = cases.earlier(extent)
        first, last = (place - SPEED * earlier for place in self.surface)
        across = (0.74, 0.77)
        if extent == "coarse":
            first, last, across = first - 0.02, last + 0.02, (0.735, 0.775)
        changed = [
            *OUTPUT, f"node_sets.waves.box=[[{first:.6g}, {across[0]}, 0], [{last:.6g}, {across[1]}, 1]]",
            f"time.end={max(self.window[1], self.contact[1]) - earlier:.6g}",
            f"output.contact_margin={0.0041 if extent == 'coarse' else 0.0011}",
        ]
        for name, (begin, end), interval in (("waves", self.window, self.interval),
                                             ("solutions", self.contact, self.contact_interval)):
            changed += [f"output_windows.{name}.start={begin - earlier:.6g}",
                        f"output_windows.{name}.end={end - earlier:.6g}", f"output_windows.{name}.interval={interval}"]
        if self.braking:
            changed.append("loads.drive.axis=[0, -1, 0]")
        if self.crack:
            changed += [f"seams.crack.place=[{CRACK - SPEED * earlier:.6g}, -0.003, 0.159]",
                        "solver.step_estimate=element"]  # nodes at the mouth are light: no step nearer to the limit
            if extent == "coarse":
                changed += ["seams.crack.length=0.03", "seams.crack.depth=0.012"]
        return changed


CRACK = 0.495  # m, where its mouth is: the wheel is there at 17.82 ms
ROLLING = Scene(1, (17.0e-3, 18.4e-3), 1e-6, (0.460, 0.530), cases.ZONE, 1e-6, tangential=False)
SCENES = {
    "creepage": Scene(4, (18.14e-3, 18.34e-3), 0.3e-6, (0.443, 0.537), (18.1e-3, 18.38e-3), 1e-5),
    "traction": ROLLING,
    "braking": dataclasses.replace(ROLLING, braking=True),
    "crack": dataclasses.replace(ROLLING, crack=True),
}
NEEDED = {"creepage": ["creepage"], "perturbation": ["traction", "braking"], "crack": ["traction", "crack"]}


def text(scene):
    """The case of a scene: the squeal's, and what is added."""
    parts = [cases.CASE, HERE / "surface.toml", *([HERE / "crack.toml"] if scene.crack else [])]
    return "".join(part.read_text(encoding="utf-8") for part in parts)


def settings(scene, extent, more=()):
    """All that is set in that case; `more`: of the command line, of sections that the case has."""
    own = [one for one in more if not one.startswith(("seams.", "contacts.crack.")) or scene.crack]
    return [*cases.EXTENTS[extent], *cases.settings(scene.case), *scene.overrides(extent), *own]


def simulate(steps, extent, parts, more=(), at_hand=None):
    """Runs what the parts need and reduces it, or takes reduced data from the folder `at_hand`. Returns Rolled by
    name."""
    found = {}
    for name in dict.fromkeys(scene for part in parts for scene in NEEDED[part]):
        scene = SCENES[name]
        path = pathlib.Path(at_hand or steps.folder) / f"{name}.npz"
        if at_hand is None:
            case = steps.write_case(f"case_{name}", text(scene))
            results = steps.run(name, case, settings(scene, extent, more))
            steps.once(f"{name}_data", [results, reduced.__file__], [scene.tangential],
                       lambda: reduced.write(path, results, scene.tangential))
        found[name] = reduced.Rolled(name, path, cases.earlier(extent))
    return found


def account(one):
    """Rows of the study's table: how sound a run was."""
    return [(f"{one.name}: energy balance over the largest elastic energy; static start; wall time, of which outputs",
             "", f"{100 * one.energy_share:.3f} %; {one['settled_unbalance']:.1e}; {one['wall_seconds']:.0f} s,"
             f" {one['output_seconds']:.0f} s")]
