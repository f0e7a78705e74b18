#!/usr/bin/env python3
"""A run over several ranks ends with the results of one process, bit for bit; so does one that is stopped and taken
up on another number of ranks. A rank that is lost ends all with a message."""

import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"]) / "tests" / "output"))
try:
    from blocks_case import BEAMS, KINDS as KINDS_OF_RUNS, case, different_arrays
except ImportError:
    sys.exit(77)

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
# So many elements that each rank has blocks of its own, and some have no node that contact knows.
FINER = {"divisions = [6, 5, 3]": "divisions = [14, 12, 9]", "divisions = [5, 5, 4]": "divisions = [12, 12, 9]",
         "divisions = [2, 2, 2]": "divisions = [4, 7, 8]"}
# Weight that shears the lower block where it is held, far from contact, so that the step follows others' elements, too.
LEANING = {**KINDS_OF_RUNS["deforming"]["instead"], "[0, 0, -1e5]": "[-9e6, 0, -9.81]",
           "velocity = [2, 1, -2]": "velocity = [5, 1, -2]"}
KINDS = {**KINDS_OF_RUNS, "float_deforming": {**KINDS_OF_RUNS["deforming"], "instead": LEANING, "end": 1.2e-4,
                                              "more": '[solver]\nprecision = "float"\n'}}
# Of the time that the kind of scene takes, until what it is about has happened: windows open, bodies meet.
SHARES = {"windows": 0.4, "global_step": 0.4, "deforming": 0.4, "float_deforming": 1, "automatic_step": 0.7}
PATIENCE = 300
BY_MPI = {"RAILWAVE_RANK_MESSAGES": "mpi"}
MPIRUN = ["mpirun", "--oversubscribe", "--bind-to", "none"]
ENVIRONMENT = dict(os.environ, OMP_WAIT_POLICY="passive", OMP_NUM_THREADS="1")
if os.geteuid() == 0:
    ENVIRONMENT.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def scene(name, share=0.15, **more):
    """@param share of the time that the kind of scene takes: runs on several ranks of few processors wait for each
    other at every step"""
    options = {**KINDS[name], **more}
    instead = dict(options.get("instead", {}))
    finer = {old: new for old, new in FINER.items() if old not in instead and old in case(**options)}
    if name.startswith("subcycling"):
        # The lower block coarse enough, and long enough where much else takes each step.
        lower = [12, 10, 16] if name == "subcycling" else [6, 5, 40]
        finer = {}
        instead.update({"divisions = [5, 5, 4]": "divisions = [18, 18, 10]",
                        "divisions = [6, 5, 3]": f"divisions = {lower}"})
    options.update(instead={**instead, **finer}, end=share * options.get("end", 1.2e-3))
    return case(**options)


def brought(said):
    """Of a run's summary: how often and how many kB of what was brought to rank 0."""
    found = re.findall(r"(energies|histories|the whole state) (\d+) times, ([0-9.e+]+) kB each", said)
    return {what: (int(times), float(size)) for what, times, size in found}


class Ranks(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.results, self.checkpoint = self.folder / "results.h5", self.folder / "results.checkpoint.h5"

    def write(self, text):
        (self.folder / "case.toml").write_text(text)

    def start(self, ranks, *options, wrapper=(), **environment):
        """@param wrapper of each rank's program"""
        command = [*wrapper, str(PROGRAM), "run", "case.toml", *options]
        if ranks > 1:
            command = [*MPIRUN, "-n", str(ranks), *command]
        return subprocess.Popen(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                env={**ENVIRONMENT, **environment})

    def run_to_end(self, ranks, *options, code=0, **environment):
        run = self.start(ranks, *options, **environment)
        said, _ = run.communicate(timeout=PATIENCE)
        self.assertEqual(run.returncode, code, said)
        return said

    def kept(self, name):
        """The results, put away."""
        place = self.folder / name
        shutil.move(self.results, place)
        return place

    def assert_same(self, one, other):
        self.assertEqual(different_arrays(one, other), [])

    def others(self, run):
        """The processes of a run, ranks in order; mpirun's children."""
        children = pathlib.Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()
        found = {}
        for child in map(int, children):
            words = pathlib.Path(f"/proc/{child}/environ").read_bytes().split(b"\0")
            for word in words:
                if word.startswith(b"OMPI_COMM_WORLD_RANK="):
                    found[int(word.partition(b"=")[2])] = child
        return [found[rank] for rank in sorted(found)]

    def need_mpi_of_devices(self):
        self.write(scene("penalty", 0.02))
        said, _ = self.start(2, **BY_MPI).communicate(timeout=PATIENCE)
        if "does not say that it takes the GPU's memory" in said:
            self.skipTest("this MPI takes no GPU's memory")
        self.results.unlink()

    def when_it_runs(self, run):
        while not self.checkpoint.exists() and run.poll() is None:
            time.sleep(0.005)
        self.assertIsNone(run.poll())


class SameResults(Ranks):
    """Made below: one test for each kind of scene."""


def add_kinds(tests, numbers_of_ranks):
    """A test for each kind of scene. @param tests a class of Ranks"""
    def add(name):
        def test(self):
            self.write(scene(name, SHARES[name]) if name in SHARES else scene(name))
            self.run_to_end(1)
            alone = self.kept("alone.h5")
            for ranks in numbers_of_ranks:
                said = self.run_to_end(ranks)
                # One process speaks for all.
                self.assertEqual(said.count("results: "), 1, said)
                self.assertGreater(brought(said)["the whole state"][1], 0, "no rank but rank 0 has an element")
                self.assert_same(alone, self.kept(f"{ranks}.h5"))
        setattr(tests, "test_" + name, test)

    for name in KINDS:
        add(name)


add_kinds(SameResults, (2, 3))


class ByMpi(Ranks):
    """Rows that MPI is given where the device has them. On a processor that is the host's memory; steps go in the order
    of a GPU's."""

    def test_same_results(self):
        self.need_mpi_of_devices()
        for name in ("multiplier", "much_else", "mixed"):
            self.write(scene(name))
            self.run_to_end(1)
            alone = self.kept("alone.h5")
            for ranks in (2, 3):
                said = self.run_to_end(ranks, **BY_MPI)
                self.assertIn(f"{ranks} ranks, rows by MPI from the device's memory;", said)
                self.assert_same(alone, self.kept(f"{ranks}.h5"))


class StaticStarts(Ranks):
    """Ranks multiply the elements' stiffness together while rank 0 searches the equilibrium by Newton's method."""

    SETTLE = "[settle]\ncache = false\nmethod = \"newton\"\n"

    def test_same_results(self):
        for name in ("multiplier", "float"):
            self.write(scene(name, 0.03) + self.SETTLE)
            said = self.run_to_end(1)
            self.assertRegex(said, r"settled after \d+ evaluations of the forces in [1-9]\d* steps of Newton's method")
            alone = self.kept("alone.h5")
            for ranks in (2, 3):
                self.run_to_end(ranks)
                self.assert_same(alone, self.kept(f"{ranks}.h5"))

    def test_ties_and_beams(self):
        self.write(scene("penalty", 0.03, more=BEAMS + self.SETTLE))
        self.run_to_end(1)
        alone = self.kept("alone.h5")
        self.run_to_end(4)
        self.assert_same(alone, self.kept("4.h5"))

    def test_a_rank_that_stalls(self):
        self.write(scene("multiplier") + self.SETTLE + "tolerance = 1e-14\n")
        run = self.start(3, RAILWAVE_RANK_PATIENCE="3")
        for line in run.stdout:
            if line.startswith("settling: "):
                break
        os.kill(self.others(run)[2], signal.SIGSTOP)
        said, _ = run.communicate(timeout=PATIENCE)
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("rank 2 has not answered rank 0 for 3 s", said)

    def test_what_is_found_while_the_scene_settles(self):
        self.write(scene("multiplier") + self.SETTLE + "[points.loose]\nmass = 1\nposition = [0, 0, 1]\n")
        said = self.run_to_end(3, code=2)
        self.assertIn("loose", said)


class Sampling(Ranks):
    """Histories and checks bring rank 0 sums, not the state."""

    def test_the_whole_state_comes_for_fields_alone(self):
        self.write(scene("multiplier"))
        outputs = 1 + round(0.15 * 1.2e-3 / 5e-5) + 1  # the beginning and the end among them
        found = brought(self.run_to_end(3))
        self.assertLessEqual(found["the whole state"][0], outputs)
        for sums in ("energies", "histories"):
            self.assertGreater(found[sums][0], 2 * outputs)
            self.assertGreater(found[sums][1], 0)
            self.assertLess(found[sums][1], 0.02 * found["the whole state"][1])

    def test_a_contact_that_has_slid_off_an_end(self):
        """It asks where whole parts are; the fault ends the run, with a file of what is around it."""
        self.write(scene("multiplier", 0.5, instead={
            "velocity = [2, 1, -2]": "velocity = [40, 0, -2]", "[0, 30, 10]": "[0, 0, 0]",
            "[0.005, 0.005, 0.03001]": "[0.052, 0.005, 0.03001]"}))
        fault = self.folder / "results.fault.h5"
        kept = {}
        for ranks in (1, 2, 3):
            said = self.run_to_end(ranks, code=3)
            self.assertIn("FAULT: a closed contact has lost all its nodes over the end of its surface", said)
            kept[ranks] = self.kept(f"{ranks}.h5"), self.folder / f"{ranks}.fault.h5"
            shutil.move(fault, kept[ranks][1])
            for one, other in zip(kept[1], kept[ranks]):
                self.assert_same(one, other)


class Restarts(Ranks):
    def test_stopped_on_four_ranks_and_taken_up_on_others(self):
        self.take_up("penalty", 0.4)

    def test_nodes_in_single_precision(self):
        self.take_up("float", 0.6)

    def take_up(self, name, share):
        self.write(scene(name, share))
        self.run_to_end(1)
        alone = self.kept("alone.h5")
        for ranks in (1, 3):
            run = self.start(4, "--set", "checkpoint.interval=0.02", "--overwrite")
            self.when_it_runs(run)
            run.send_signal(signal.SIGUSR1)  # which mpirun passes on to all ranks
            said, _ = run.communicate(timeout=PATIENCE)
            self.assertIn("interrupted at step", said)
            self.assertTrue(self.checkpoint.exists())
            said = self.run_to_end(ranks, "--restart")
            self.assertIn("restart: goes on from results.checkpoint.h5: step ", said)
            self.assert_same(alone, self.kept(f"from-4-on-{ranks}.h5"))


class Refusals(Ranks):
    def test_a_mistake_in_the_case_is_said_once(self):
        self.write(scene("penalty").replace("friction = 0.3", 'friction = "much"'))
        said = self.run_to_end(3, code=2)
        self.assertEqual(said.count("railwave: case.toml"), 1, said)
        self.assertFalse(self.results.exists())

    def test_what_is_found_as_the_run_begins(self):
        self.write(scene("penalty").replace('parts = ["upper"]', 'parts = ["lower"]'))
        said = self.run_to_end(2, code=2)
        self.assertIn("railwave: case.toml", said)

    def test_check_says_how_a_case_is_dealt_out(self):
        self.write(scene("penalty"))
        done = subprocess.run([PROGRAM, "check", "case.toml", "--ranks", "3"], cwd=self.folder, text=True,
                              capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        elements = [int(one) for one in re.findall(r"^  rank \d: (\d+) elements", done.stdout, re.MULTILINE)]
        self.assertEqual(len(elements), 3)
        self.assertEqual(sum(elements), int(re.search(r"in all: (\d+) elements", done.stdout)[1]))

    def test_sets_of_histories_bind_no_elements(self):
        self.write(scene("penalty"))
        bound = []
        for sets in ("[]", '["upper.z_max", "lower.core"]'):
            done = subprocess.run([PROGRAM, "check", "case.toml", "--ranks", "3", "--set",
                                   "output.history_sets=" + sets], cwd=self.folder, text=True, capture_output=True)
            bound.append(re.search(r"rank 0 has all (\d+) elements|$", done.stdout)[1])
        self.assertEqual(bound[0], bound[1])


    def test_processes_with_different_cases(self):
        self.write(scene("penalty"))
        (self.folder / "other.toml").write_text(scene("penalty").replace("density = 7800", "density = 7801"))
        run = subprocess.run([*MPIRUN, "-n", "1", str(PROGRAM), "run", "case.toml", ":", "-n", "1", str(PROGRAM), "run",
                              "other.toml"], cwd=self.folder, text=True, capture_output=True, env=ENVIRONMENT,
                             timeout=PATIENCE, check=False)
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("1: this process has another model than rank 0", run.stderr)

    def test_processes_with_different_settings(self):
        """Also where models begin alike."""
        self.write(scene("penalty"))
        command = [str(PROGRAM), "run", "case.toml"]
        for setting in ("monitor.active=false", "solver.subcycling=true", "output.history_interval=1e-6"):
            run = subprocess.run([*MPIRUN, "-n", "2", *command, ":", "-n", "1", *command, "--set", setting],
                                 cwd=self.folder, text=True, capture_output=True, env=ENVIRONMENT, timeout=PATIENCE,
                                 check=False)
            self.assertEqual(run.returncode, 1, run.stderr)
            self.assertIn("2: this process has another model than rank 0", run.stderr)
            self.assertFalse(self.results.exists())


class WaysOfRows(Ranks):
    def test_that_there_are_not(self):
        self.write(scene("penalty", 0.02))
        said = self.run_to_end(2, code=2, RAILWAVE_RANK_MESSAGES="gpu")
        refused = "RAILWAVE_RANK_MESSAGES is 'gpu': auto, direct, nccl, mpi or host is wanted"
        self.assertEqual(said.count(refused), 1, said)
        self.assertFalse(self.results.exists())
        if "from GPU to GPU" in self.run_to_end(2):
            return
        self.results.unlink()
        said = self.start(2, RAILWAVE_RANK_MESSAGES="nccl").communicate(timeout=PATIENCE)[0]
        self.assertRegex(said, "built without NCCL|NCCL, which RAILWAVE_RANK_MESSAGES=nccl wants, cannot join")

    def test_from_gpu_to_gpu(self):
        self.write(scene("penalty"))
        said = self.run_to_end(2)
        if "rows from GPU to GPU" not in said:
            self.skipTest("this takes two GPUs of one host")
        direct = self.kept("direct.h5")
        self.run_to_end(2, RAILWAVE_RANK_MESSAGES="host")
        self.assert_same(direct, self.results)

    def test_through_the_host(self):
        self.write(scene("penalty", 0.02))
        self.assertIn("3 ranks, rows through the host;", self.run_to_end(3, RAILWAVE_RANK_MESSAGES="host"))


class Ensembles(Ranks):
    """Members are dealt out to ranks; each is what it is alone."""

    MEMBERS = ("contacts.between.friction=0.2", "contacts.between.friction=0.4", "contacts.between.friction=0.5")

    def ensemble(self, *more):
        words = [word for number, one in enumerate(self.MEMBERS)
                 for word in ("--member", one, f"output.file=member_{number}.h5")]
        return subprocess.run([*MPIRUN, "-n", "2", str(PROGRAM), "ensemble", "case.toml", *words, *more], text=True,
                              cwd=self.folder, capture_output=True, env=ENVIRONMENT, timeout=PATIENCE, check=False)

    def test_members_are_what_they_are_alone(self):
        self.write(scene("penalty"))
        done = self.ensemble()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count(": completed"), len(self.MEMBERS), done.stdout)
        for number, one in enumerate(self.MEMBERS):
            self.run_to_end(1, "--set", one)
            self.assert_same(self.kept(f"alone_{number}.h5"), self.folder / f"member_{number}.h5")

    def test_a_member_that_is_refused_stops_all_before_they_begin(self):
        self.write(scene("penalty"))
        done = self.ensemble("--member", "contacts.between.friction=-1", "output.file=member_3.h5")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("member 4 of the ensemble: ", done.stderr)
        self.assertFalse((self.folder / "member_0.h5").exists())


class OfOthers(Ranks):
    def test_runs_of_a_sweep_are_alone(self):
        self.write(scene("penalty", 0.02))
        (self.folder / "study.toml").write_text("""case = "case.toml"
[grid]
contacts.between.friction = [0.2, 0.3]
[figures]
friction_work = "energy.friction"
""")
        done = subprocess.run([*MPIRUN, "-n", "2", str(PROGRAM), "sweep", "study.toml", "--no-pictures"], text=True,
                              cwd=self.folder, capture_output=True, env=ENVIRONMENT, timeout=PATIENCE, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_a_task_of_a_scheduler_is_a_run_of_its_own(self):
        self.write(scene("penalty", 0.02))
        self.assertIn("results: ", self.run_to_end(1, SLURM_PROCID="3", SLURM_STEP_NUM_TASKS="4"))


class LostRanks(Ranks):
    def lose(self, rank, number, **environment):
        self.write(scene("penalty", field_interval=1e-5))
        run = self.start(3, "--set", "checkpoint.interval=0.02", "--set", "time.end=1", RAILWAVE_RANK_PATIENCE="8",
                         **environment)
        self.when_it_runs(run)
        began = time.monotonic()
        os.kill(self.others(run)[rank], number)
        said, _ = run.communicate(timeout=PATIENCE)
        self.assertLess(time.monotonic() - began, 30)
        self.assertNotEqual(run.returncode, 0)
        self.assertTrue(self.checkpoint.exists())
        end = time.monotonic()
        self.assertIn("restart: goes on from", self.run_to_end(2, "--restart", "--set", "time.end=1",
                                                               "--wall-time", "2", code=4))
        self.assertLess(time.monotonic() - end, 120)
        return said

    def test_a_killed_rank_ends_all(self):
        self.assertRegex(self.lose(1, signal.SIGKILL), r"rank 1 .*(signal 9|Killed)")

    def test_ranks_that_are_all_held_for_a_while_go_on(self):
        """As by a scheduler that lets others go first."""
        self.write(scene("penalty", 0.02))
        self.run_to_end(1, "--set", "time.end=1e-3")
        alone = self.kept("alone.h5")
        run = self.start(3, "--set", "time.end=1e-3", "--set", "checkpoint.interval=0.02",
                         RAILWAVE_RANK_PATIENCE="1")
        self.when_it_runs(run)
        ranks = self.others(run)
        for number in (signal.SIGSTOP, signal.SIGCONT):
            for rank in ranks:
                os.kill(rank, number)
            time.sleep(2.5 if number == signal.SIGSTOP else 0)
        said, _ = run.communicate(timeout=PATIENCE)
        self.assertEqual(run.returncode, 0, said)
        self.assert_same(alone, self.results)

    def test_a_rank_that_stalls_ends_all(self):
        self.assertIn("rank 2 has not answered rank", self.lose(2, signal.SIGSTOP))

    def test_a_rank_that_stalls_where_mpi_has_the_rows_from_devices(self):
        self.need_mpi_of_devices()
        self.assertIn("rank 2 has not answered rank", self.lose(2, signal.SIGSTOP, **BY_MPI))


def need_ranks():
    """Leaves where the program or the machine knows no ranks."""
    knows = subprocess.run([PROGRAM, "check", "nothing.toml", "--ranks", "2"], capture_output=True, text=True)
    if shutil.which("mpirun") is None or "built without MPI" in knows.stderr:
        sys.exit(77)
    started = subprocess.run([*MPIRUN, "-n", "2", "true"], capture_output=True, text=True, env=ENVIRONMENT)
    if started.returncode != 0:
        print(f"mpirun starts nothing on this machine: {started.stderr}")
        sys.exit(77)


if __name__ == "__main__":
    need_ranks()
    unittest.main()
