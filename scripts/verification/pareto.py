"""Run time against error of the contact's algorithms: the runs of one machine, each in its own process, and their table
runs.csv. Errors are those of verification.cases: Hertz's of the settled roller on a crown, Kalker's of force set (a) of
thesis table 5.2. SI units."""

import concurrent.futures
import csv
import os
import pathlib
import queue
import re
import shutil
import subprocess
import threading
import time
from dataclasses import dataclass

from verification.exact import Hertz
from verification.rolling import RADIUS_ACROSS
from verification.setting import RADIUS

ROOT = pathlib.Path(os.path.realpath(__file__)).parents[2]
MINOR_AXIS = 2 * Hertz(126680, RADIUS, RADIUS_ACROSS).b

# By scene: the case of verification.cases, its points, and the column of each of its figures.
SCENES = {
    "hertz": ("hertz_ellipse", None, {
        "peak pressure, Pa": "peak_pressure_error", "patch area, m2": "area_error", "approach, m": "approach_error",
        "pressure over the patch, L2": "stress_error"}),
    "rolling": ("rolling", ["a"], {
        "(a) peak pressure, Pa": "peak_pressure_error", "(a) patch area, m2": "area_error",
        "(a) normal force, N": "normal_force_error",
        "(a) stick share of the patch, zero line": "stick_share_error",
        "(a) tangential over friction times normal force": "creep_force_error",
        "(a) creepage for these forces": "creepage_error", "(a) shear over the patch, L2": "stress_error",
        "(a) swing of the creep force": "creep_force_swing"}),
}
ERRORS = ["peak_pressure_error", "area_error", "approach_error", "stick_share_error", "creep_force_error",
          "creepage_error", "normal_force_error", "stress_error", "creep_force_swing"]
COLUMNS = ["scene", "algorithm", "scale", "growth", "elements_across", "status", "wall_s", "settling_s", "running_s",
           "process_s", "settling_evaluations", "steps", "step_s", "elements", "element_steps_per_s", *ERRORS,
           "threads", "jobs", "device", "processor_s"]
LATER = {"processor_s"}  # that older tables lack

DONE = ("done", "not settled")  # of rows: the latter took settle.max_steps, and was measured as it stood


@dataclass(frozen=True)
class Method:
    """Multipliers, or penalty springs of a scale f_SI whose stiffness may grow with penetration."""
    algorithm: str
    scale: float = 1.0
    growth: bool = False

    @classmethod
    def named(cls, text):
        """Of "multiplier", "penalty-SCALE" or "penalty-SCALE-growth"."""
        if text == "multiplier":
            return cls("multiplier")
        found = re.fullmatch(r"penalty-([0-9.]+(?:e-?[0-9]+)?)(-growth)?", text)
        try:
            scale = float(found.group(1))
        except (AttributeError, ValueError):
            scale = 0.0
        if not 0 < scale <= 1e6:
            raise ValueError(f"'{text}' is no method; write multiplier, penalty-SCALE or penalty-SCALE-growth with a "
                             "scale above 0, as in penalty-2")
        return cls("penalty", scale, found.group(2) is not None)

    @property
    def name(self):
        if self.algorithm == "multiplier":
            return "multiplier"
        return f"penalty-{self.scale:g}" + ("-growth" if self.growth else "")

    def overrides(self, contact, size):
        """Growth: four times as stiff at the penetration that a spring of this scale has under some 900 MPa in elements
        of this size, p h / (f_SI K) = h / 200 f_SI, and as the scale says where it begins to touch."""
        keys = [f"algorithm={self.algorithm}"]
        if self.algorithm == "penalty":
            keys.append(f"penalty_scale={self.scale:g}")
        if self.growth:
            keys.append(f"penalty_growth=[[0,1],[{size / 200 / self.scale:.6g},4]]")
        return [f"contacts.{contact}.{key}" for key in keys]


METHODS = [Method.named(name) for name in (
    "multiplier", "penalty-0.5", "penalty-1", "penalty-2", "penalty-5", "penalty-10", "penalty-0.5-growth",
    "penalty-1-growth", "penalty-2-growth")]


@dataclass(frozen=True)
class Job:
    scene: str
    method: Method
    elements: int

    @property
    def label(self):
        return f"{self.scene}-{self.elements}-{self.method.name}"

    @property
    def key(self):
        return self.scene, self.method.algorithm, f"{self.method.scale:g}", str(int(self.method.growth)), \
            str(self.elements)


def plan(scenes, methods, elements):
    """All runs, the cheap ones first: a step costs elements^3, and there are `elements` times as many, more with stiff
    springs."""
    def cost(job):
        steps = 1 if job.scene == "hertz" else 3
        return job.elements**4 * steps, job.method.algorithm == "penalty", job.method.scale
    return sorted((Job(s, m, e) for s in scenes for m in methods for e in elements), key=cost)


def read_table(path):
    """Rows of runs.csv, as texts. Throws ValueError where it is none."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    if missing := [name for name in COLUMNS if rows and name not in rows[0] and name not in LATER]:
        raise ValueError(f"{path} is no table of scripts/contact_pareto: it has no column {', '.join(missing)}")
    if any(None in row or None in row.values() for row in rows):
        raise ValueError(f"{path}: a row has more or fewer values than there are columns")
    return [{**dict.fromkeys(COLUMNS, ""), **row} for row in rows]


def key_of(row):
    return tuple(row[name] for name in ("scene", "algorithm", "scale", "growth", "elements_across"))


class Table:
    """runs.csv, which has each run as soon as it is done."""

    def __init__(self, path):
        self.path, self.lock = pathlib.Path(path), threading.Lock()
        self.rows = read_table(self.path) if self.path.exists() else []

    def has(self, job, device):
        return any(key_of(row) == job.key and row["device"] == device and row["status"] in DONE for row in self.rows)

    def add(self, row):
        """In place of an earlier attempt at the same run. The file is replaced as a whole."""
        with self.lock:
            same = (key_of(row), row["device"])
            self.rows = [r for r in self.rows if (key_of(r), r["device"]) != same] + [row]
            fresh = self.path.with_suffix(".csv.new")
            with open(fresh, "w", encoding="utf-8", newline="") as file:
                writer = csv.DictWriter(file, COLUMNS)
                writer.writeheader()
                writer.writerows(self.rows)
            os.replace(fresh, self.path)


class RunFailed(RuntimeError):
    pass


class OneRun:
    """Runs a case for verification.cases and remembers what it cost."""

    def __init__(self, folder, program, environment, prefix):
        self.folder, self.program, self.environment, self.prefix = folder, program, environment, prefix
        self.cost, self.results = {}, None

    def __call__(self, label, case, overrides):
        from verification.measured import Run

        results, log = self.folder / f"{label}.h5", self.folder.parent / f"{label}.log"
        command = [*self.prefix, self.program, "run", str(ROOT / "cases" / "verify" / f"{case}.toml")]
        for override in [*overrides, "settle.cache=false", "checkpoint.interval=0", "output.progress_interval=1e9",
                         f"output.file={results}"]:
            command += ["--set", override]
        begin = time.monotonic()
        with open(log, "w", encoding="utf-8") as file:
            file.write(" ".join(command) + "\n")
            file.flush()
            run = subprocess.Popen(command, stdout=file, stderr=subprocess.STDOUT, env=self.environment)
            _, status, used = os.wait4(run.pid, 0)
            code = run.returncode = os.waitstatus_to_exitcode(status)
        process = time.monotonic() - begin
        said = log.read_text(encoding="utf-8", errors="replace")
        if code != 0:
            raise RunFailed(f"railwave ended with {code}, see {log}: " + " ".join(said.split("\n")[-4:])[-300:])
        settled = re.search(r"settled after (\d+) evaluations of the forces.*?, ([0-9.]+) s:", said)
        if not settled:
            raise RunFailed(f"{log} does not say how long the scene settled")
        run = Run(results)
        settling = float(settled.group(2))
        self.cost = dict(
            wall_s=settling + run.seconds, settling_s=settling, running_s=run.seconds, process_s=process,
            settling_evaluations=int(settled.group(1)), steps=run.steps, step_s=run.step_size, elements=run.elements,
            element_steps_per_s=float(run.file.attrs["element_steps_per_second"]),
            status="not settled" if "NOT settled" in said else "done", processor_s=used.ru_utime + used.ru_stime,
        )
        self.results = run
        return run


def errors_of(figures, columns):
    """By column: relative errors; of what is exact as 0, the share itself."""
    found = {what: computed / exact - 1 if exact else computed for what, computed, exact, _ in figures}
    return {column: float(found[what]) for what, column in columns.items()}


def execute(job, folder, program, environment, prefix=()):
    """@return the row of this run, without what all runs of the machine share"""
    from verification.cases import CASES

    case, points, columns = SCENES[job.scene]
    row = dict.fromkeys(COLUMNS, "")
    row.update(zip(("scene", "algorithm", "scale", "growth", "elements_across"), job.key))
    place = pathlib.Path(folder) / job.label
    place.mkdir(parents=True, exist_ok=True)
    run = OneRun(place, program, environment, list(prefix))
    try:
        outcome = CASES[case](
            run, job.label, job.elements,
            job.method.overrides(CASES[case].contact, MINOR_AXIS / job.elements), points,
        )
        row.update(run.cost)
        row.update(errors_of(outcome.figures, columns))
    except (RunFailed, OSError, ValueError, IndexError, KeyError, ArithmeticError) as error:
        row.update(run.cost)
        row["status"] = "failed: " + " ".join(str(error).split())
    finally:
        if run.results:
            run.results.file.close()
        shutil.rmtree(place, ignore_errors=True)
    return {name: f"{value:.6g}" if isinstance(value, float) else str(value) for name, value in row.items()}


def processors(slots, threads):
    """By slot, the command that keeps a run on processors of its own; none where one run has the machine, or where they
    are too few."""
    available = sorted(os.sched_getaffinity(0))
    if slots == 1 or not threads or slots * threads > len(available) or not shutil.which("taskset"):
        return [[] for _ in range(slots)]
    return [
        ["taskset", "-c", ",".join(map(str, available[k * threads:(k + 1) * threads]))] for k in range(slots)
    ]


def run_all(jobs, folder, program, device, slots=1, threads=None, seconds=None, processor_time=False, report=print):
    """Runs what runs.csv in the folder has not yet. @param processor_time the time that counts is the processor's, of
    the whole process. @return rows of this call"""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    table = Table(folder / "runs.csv")
    end = time.monotonic() + seconds if seconds else None
    environment = dict(os.environ)
    if threads:
        environment.update(OMP_NUM_THREADS=str(threads), KOKKOS_NUM_THREADS=str(threads))
    free = queue.SimpleQueue()
    for prefix in processors(slots, threads):
        free.put(prefix)

    def one(job):
        if table.has(job, device):
            report(f"{job.label}: in {table.path} already")
            return None
        if end and time.monotonic() > end:
            report(f"{job.label}: not begun, {seconds:g} s have passed")
            return None
        prefix = free.get()
        try:
            row = execute(job, folder, program, environment, prefix)
        finally:
            free.put(prefix)
        row.update(threads=str(threads or ""), jobs=str(slots), device=device)
        if not processor_time:
            row["processor_s"] = ""
        table.add(row)
        report(line(row))
        return row

    with concurrent.futures.ThreadPoolExecutor(slots) as pool:
        return [row for row in pool.map(one, jobs) if row]


def time_of(row):
    """s, what counts: settling and steps by the clock, or the whole process by the processor's time where a table has
    that."""
    return float(row["processor_s"] or row["wall_s"])


def line(row):
    name = f"{row['scene']} {row['elements_across']} " + Method(
        row["algorithm"], float(row["scale"]), row["growth"] == "1").name
    if row["status"] != "done" and not row["wall_s"]:
        return f"{name}: {row['status']}"
    errors = ", ".join(
        f"{column.replace('_error', '').replace('_', ' ')} {100 * float(row[column]):+.2f} %"
        for column in ERRORS if row[column]
    )
    remark = "" if row["status"] == "done" else f" ({row['status']})"
    return f"{name}: {time_of(row):.2f} s, {errors}{remark}"
