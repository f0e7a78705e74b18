"""The time of a step by number of ranks: tables of measured runs and of partitions, a model fitted to them, and what it
forecasts. For rank_forecast. Times are in s, sizes in bytes.

A step of several ranks takes
    fixed + per_element * elements of a rank + several + per_row * rows that a rank sends + contact + network.
The first four, and what a run over several ranks takes besides its steps, are fitted to runs. Contact is what rank 0
takes beyond its elements; it is the difference of a scene's runs from that."""

import csv
import dataclasses
import math

import numpy as np
from scipy.optimize import nnls

ROW = 32  # bytes of a row of partial forces in double precision
TERMS = ("fixed", "per_element", "several", "per_row", "start")
BALANCED_BY_HALVING = 8  # ranks up to which METIS halves parts; beyond it allows the imbalance below
IMBALANCE = 1.03
INNER_RANKS = 8  # from which on parts have neighbours on several sides
# Elements of outer blocks for each row sent: 542 blocks of 128 for the 19946 rows of 2 million elements on two ranks.
OUTER_ELEMENTS_OF_ROW = 3.5


class BadTable(ValueError):
    """What is wrong with a table, and how to mend it."""


@dataclasses.dataclass(frozen=True)
class Partition:
    """How a scene is dealt out, as `railwave check --ranks N` says."""

    scene: str
    elements: int
    ranks: int
    largest_elements: int  # of a rank
    rank_0_elements: int
    bound_elements: int  # that rank 0 must have
    rows: int  # the most that a rank sends
    neighbours: int  # the most that a rank has


@dataclasses.dataclass(frozen=True)
class Run:
    """A measured run."""

    device: str
    commit: str
    scene: str
    ranks: int
    elements: int
    steps: int
    million_element_steps_per_s: float

    @property
    def step_time(self):
        return self.elements / (1e6 * self.million_element_steps_per_s)


def read_table(path, row):
    """Rows of a CSV file as a dataclass. Lines that begin with # are remarks."""
    kinds = {field.name: field.type for field in dataclasses.fields(row)}
    rows = []
    with open(path, encoding="utf-8", newline="") as file:
        lines = [(number, line) for number, line in enumerate(file, 1) if line.strip() and not line.startswith("#")]
    reader = csv.DictReader(line for _, line in lines)
    if reader.fieldnames != list(kinds):
        raise BadTable(f"{path}: its columns are {','.join(reader.fieldnames or ())}, wanted are {','.join(kinds)}")
    for (number, _), values in zip(lines[1:], reader):
        try:
            one = row(**{name: kinds[name](values[name]) for name in kinds})
        except (TypeError, ValueError) as error:
            raise BadTable(f"{path}:{number}: {error}; write one number in each column but those of names") from None
        for name, kind in kinds.items():
            if kind is not str and not (math.isfinite(getattr(one, name)) and getattr(one, name) >= 0):
                raise BadTable(f"{path}:{number}: {name} is {getattr(one, name)}; a number from 0 on is wanted")
        rows.append(one)
    return rows


def write_table(path, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(field.name for field in dataclasses.fields(rows[0]))
        writer.writerows(dataclasses.astuple(one) for one in rows)


class Partitions:
    """By scene, elements and ranks; and a law for what was not dealt out."""

    def __init__(self, rows):
        self.known = {(one.scene, one.elements, one.ranks): one for one in rows}

    def of(self, run):
        if run.ranks == 1:
            return Partition(run.scene, run.elements, 1, run.elements, run.elements, 0, 0, 0)
        if (run.scene, run.elements, run.ranks) not in self.known:
            raise BadTable(f"there is no partition of {run.scene}, {run.elements} elements, on {run.ranks} ranks: "
                           "scripts/rank_forecast --add-partitions makes it")
        return self.known[run.scene, run.elements, run.ranks]

    def balanced(self, scene):
        """Those in which what binds blocks to rank 0 is no more than half of its share."""
        return [one for key, one in sorted(self.known.items()) if key[0] == scene
                and one.bound_elements < 0.5 * one.elements / one.ranks]

    def rows_and_neighbours(self, scene, elements, ranks):
        """Rows grow as faces do, by the power 2/3 of a rank's elements: the mean of all partitions with neighbours on
        several sides; of fewer ranks the nearest size of as many."""
        power = (elements / ranks) ** (2 / 3)
        alike = [one for one in self.balanced(scene) if one.ranks == ranks < INNER_RANKS]
        inner = [one for one in self.balanced(scene) if one.ranks >= INNER_RANKS]
        if alike:
            inner = [min(alike, key=lambda one: abs(math.log(one.elements / elements)))]
        if not inner:
            raise BadTable(f"no partition of {scene} on {INNER_RANKS} or more ranks: scripts/rank_forecast "
                           "--add-partitions makes some")
        rows = float(np.mean([one.rows / (one.elements / one.ranks) ** (2 / 3) for one in inner]))
        return round(rows * power), min(max(one.neighbours for one in inner), ranks - 1)

    def forecast(self, scene, elements, ranks):
        """As it was dealt out, else by these laws. What binds blocks to rank 0 is a face of the bar."""
        if ranks == 1 or (scene, elements, ranks) in self.known:
            return self.of(Run("", "", scene, ranks, elements, 1, 1.0))
        own = elements / ranks
        bound = max((one.bound_elements / one.elements ** (2 / 3) for key, one in self.known.items()
                     if key[0] == scene), default=0) * elements ** (2 / 3)
        largest = max(own * (1 if ranks <= BALANCED_BY_HALVING else IMBALANCE), bound)
        rows, neighbours = self.rows_and_neighbours(scene, elements, ranks)
        return Partition(scene, elements, ranks, round(largest), round(max(own, bound)), round(bound), rows, neighbours)


@dataclasses.dataclass(frozen=True)
class Network:
    """Between hosts; nothing of it was measured."""

    gpus_of_host: int
    bandwidth: float  # bytes/s of a GPU
    latency: float  # s of an exchange with one neighbour
    neighbour_latency: float  # s more for each other neighbour

    def exposed(self, partition, per_element):
        """s of an exchange that the inner blocks do not hide. All rows are taken for such as go to another host."""
        if partition.ranks <= self.gpus_of_host:
            return 0.0
        exchange = (self.latency + self.neighbour_latency * (partition.neighbours - 1)
                    + ROW * partition.rows / self.bandwidth)
        inner = max(0.0, partition.elements / partition.ranks - OUTER_ELEMENTS_OF_ROW * partition.rows)
        return max(0.0, exchange - per_element * inner)


class Model:
    """Terms of a step's time, by name; `contact` by scene: s on one rank and on several."""

    def __init__(self, terms):
        self.terms, self.contact = dict(zip(TERMS, terms)), {}

    @staticmethod
    def _line(run, partition):
        several = 1.0 if run.ranks > 1 else 0.0
        return [1.0, partition.largest_elements, several, several * partition.rows, several / run.steps]

    @classmethod
    def fit(cls, runs, partitions):
        """Least squares of the relative errors of step times, with terms from 0 on."""
        lines = np.array([cls._line(run, partitions.of(run)) for run in runs])
        times = np.array([run.step_time for run in runs])
        scale = np.maximum(np.abs(lines).max(axis=0), 1e-300)
        if len(runs) < len(TERMS) or np.linalg.matrix_rank(lines / scale / times[:, None]) < len(TERMS):
            raise BadTable(f"{len(runs)} runs without contact do not fix the {len(TERMS)} terms {', '.join(TERMS)}: "
                           "they must be of one and of several ranks, of several sizes and numbers of steps")
        found, _ = nnls(lines / scale / times[:, None], np.ones(len(runs)))
        return cls(found / scale)

    def parts(self, partition):
        """s of a step without contact and network, by what it is for."""
        terms, several = self.terms, partition.ranks > 1
        return {"elements": terms["per_element"] * partition.largest_elements, "fixed": terms["fixed"],
                "several ranks": terms["several"] if several else 0.0,
                "rows": terms["per_row"] * partition.rows if several else 0.0}

    def run_time(self, run, partition):
        """s of a step of a run without contact, with its share of the run's start."""
        return float(np.dot(self._line(run, partition), [self.terms[name] for name in TERMS]))

    def take_contact(self, run, partition):
        """What rank 0 takes beyond its elements."""
        parts, start = self.parts(partition), self.terms["start"] / run.steps if run.ranks > 1 else 0.0
        rest = run.step_time - start - (sum(parts.values()) - parts["elements"])
        own = rest - self.terms["per_element"] * partition.rank_0_elements
        self.contact.setdefault(run.scene, {})[run.ranks > 1] = own

    def step(self, partition, network, contact=None):
        """s of a step by what it is for. @param contact s, on rank 0; default: the scene's"""
        parts = self.parts(partition)
        if contact is None:
            contact = self.contact.get(partition.scene, {}).get(partition.ranks > 1, 0.0)
        of_rank_0 = self.terms["per_element"] * partition.rank_0_elements + contact
        parts["contact"] = max(0.0, of_rank_0 - parts["elements"])
        parts["network"] = network.exposed(partition, self.terms["per_element"])
        return parts
