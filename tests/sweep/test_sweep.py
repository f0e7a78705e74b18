#!/usr/bin/python3
"""railwave sweep: its table, what its members have to do with each other (nothing), kills, resuming."""

import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import tomllib
import unittest

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

import studies
from studies import PROGRAM, ROOT, leftovers, members, rows, sweep, write

PATIENCE = 300  # s
HEAT = """
[figures]
heat = "energy.friction"
"""


def arrays(path):
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()].tobytes()} if hasattr(item, "shape") else {}))
    return found


def times_run(member):
    """How often the member's run came to its end, by what the runs themselves said."""
    return (member / "log.txt").read_text().count("\nresults: ")


def children(process):
    try:
        return [int(word) for word in pathlib.Path(f"/proc/{process}/task/{process}/children").read_text().split()]
    except OSError:
        return []


def is_running(process):
    """A process that has ended may stay listed, as a zombie: whoever takes orphans in need not ask for their ends."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return False


class SweepTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(os.path.realpath(temporary.name))


class Whole(SweepTest):
    def test_table_members_alone_and_again(self):
        study = write(self.folder)
        done = sweep(study, "--jobs", "2", "--threads", "1")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        table = rows(study)
        self.assertEqual(len(table), 6)
        self.assertEqual({row["status"] for row in table}, {"completed"})
        friction, speed = "contacts.between.friction", "initial_motion.slide.velocity[0] [m/s]"
        self.assertEqual([row[friction] for row in table], ["0.2"] * 3 + ["0.4"] * 3)
        self.assertEqual([row[speed] for row in table], ["3", "4", "6"] * 2)
        for row in table:
            # All that slides has come down by friction's share of the load, and no more.
            self.assertLess(float(row["speed [m/s]"]), float(row[speed]))
            self.assertGreater(float(row["heat [J]"]), 0)
            self.assertGreater(float(row["rattle [Hz]"]), 0)
        heat = [float(row["heat [J]"]) for row in table]
        self.assertTrue(heat[0] < heat[1] < heat[2] and heat[0] < heat[3])
        with h5py.File(self.folder / "out" / "sweep.h5") as file:
            np.testing.assert_allclose(file["figures/heat"][:], heat, rtol=1e-9)
            self.assertEqual(file["figures/heat"].attrs["unit"], "J")
            self.assertEqual(list(file["status"][:]), [0] * 6)
            np.testing.assert_array_equal(file[f"parameters/{speed.split(' ')[0]}"][:], [3, 4, 6] * 2)
            self.assertEqual(len(file.attrs["folders"]), 6)
            folders = [str(name) for name in file.attrs["folders"]]
        self.assertEqual(leftovers(study), [])

        # Each is bit for bit what it is alone.
        for number, overrides in ((1, ("0.2", "3")), (6, ("0.4", "6"))):
            alone = self.folder / "alone.h5"
            subprocess.run(
                [
                    PROGRAM, "run", self.folder / "case.toml", "--set", f"output.file={alone}", "--overwrite", "--set",
                    f"contacts.between.friction={overrides[0]}", "--set",
                    f"initial_motion.slide.velocity[0]={overrides[1]}", "--set", "settle.cache=false",
                ],
                check=True, capture_output=True,
            )
            member = self.folder / "out" / "members" / folders[number - 1]
            self.assertEqual(arrays(alone), arrays(member / "results.h5"))

        # A second time nothing is run, and the table is the same.
        text = (self.folder / "out" / "sweep.csv").read_text()
        again = sweep(study)
        self.assertEqual(again.returncode, 0)
        self.assertIn("6 of 6 members are done already", again.stdout)
        self.assertEqual((self.folder / "out" / "sweep.csv").read_text(), text)
        self.assertEqual([times_run(member) for member in members(study)], [1] * 6)

        # Other figures are collected from the results that are there; a longer grid runs what is new.
        write(self.folder, studies.GRID.replace("0.2, 0.4", "0.2, 0.3, 0.4") + HEAT)
        more = sweep(study)
        self.assertEqual(more.returncode, 0, more.stdout + more.stderr)
        table = rows(study)
        self.assertEqual(len(table), 9)
        self.assertNotIn("area [m2]", table[0])
        self.assertEqual([row["heat [J]"] for row in table[:3]], [f"{value:.10g}" for value in heat[:3]])
        self.assertEqual([times_run(member) for member in members(study)], [1] * 9)

    def test_shares_of_jobs_make_the_same_table(self):
        study = write(self.folder)
        self.assertEqual(sweep(study, "--job", "1/2").returncode, 0)
        self.assertFalse((self.folder / "out" / "sweep.csv").exists())
        self.assertEqual(len(members(study)), 3)
        self.assertEqual(sweep(study, "--members", "2,4-6").returncode, 0)
        self.assertEqual(len(members(study)), 6)
        done = sweep(study, "--collect")
        self.assertEqual(done.returncode, 0, done.stderr)
        split = (self.folder / "out" / "sweep.csv").read_text()
        other = self.folder / "other"
        other.mkdir()
        whole = write(other)
        self.assertEqual(sweep(whole).returncode, 0)
        self.assertEqual((other / "out" / "sweep.csv").read_text(), split)

    def test_two_sweeps_at_once_share_the_members(self):
        study = write(self.folder)
        both = [
            subprocess.Popen(
                [PROGRAM, "sweep", study, "--no-pictures", "--jobs", "1"], stdout=subprocess.PIPE, text=True
            )
            for _ in range(2)
        ]
        for process in both:
            process.communicate(timeout=PATIENCE)
            self.assertEqual(process.returncode, 0)
        self.assertEqual([times_run(member) for member in members(study)], [1] * 6)
        self.assertEqual({row["status"] for row in rows(study)}, {"completed"})
        self.assertEqual(leftovers(study), [])

    def test_dry_run_writes_nothing(self):
        study = write(self.folder)
        done = sweep(study, "--dry-run")
        self.assertEqual(done.returncode, 0)
        self.assertIn("member 6: friction=0.4, velocity[0]=6: to be run", done.stdout)
        self.assertFalse((self.folder / "out").exists())

    def test_scripts_of_slurm_take_the_processors_that_they_ask_for(self):
        study = write(self.folder, studies.GRID + studies.FIGURES + "[slurm]\ncpus_per_job = 3\n")
        said = sweep(study, "--slurm", "4", "--dry-run").stdout
        self.assertIn("#SBATCH --array=1-4\n", said)
        self.assertIn("#SBATCH --cpus-per-task=3\n", said)
        self.assertIn('--job "$SLURM_ARRAY_TASK_ID/4" --jobs 3 --threads 1 --no-pictures', said)
        self.assertIn("--collect", said)
        self.assertFalse((self.folder / "out").exists())

    def test_pictures(self):
        study = write(self.folder, "[grid]\ncontacts.between.friction = [0.1, 0.2]\n" + HEAT)
        done = subprocess.run([PROGRAM, "sweep", study], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue((self.folder / "out" / "sweep-heat.png").exists(), done.stdout + done.stderr)

    def test_pictures_of_many_members(self):
        # More than twelve lines: points by colour; a text as parameter; a member that did not complete.
        path = self.folder / "made-up.h5"
        parts = np.indices((2, 5, 4)).reshape(3, -1).astype(float)
        with h5py.File(path, "w") as file:
            file.attrs.update({"format": "Railwave sweep", "title": "made up"})
            file["status"] = np.where(np.arange(40) == 7, 1.0, 0.0)
            for name, values in zip(("parts.a.hourglass", "b", "c"), parts):
                file[f"parameters/{name}"] = values
                file[f"parameters/{name}"].attrs["unit"] = "m"
            file["parameters"].attrs["parts.a.hourglass"] = ["stiffness", "viscous"]
            file["figures/force"] = np.where(np.arange(40) == 7, np.nan, parts[1] ** 2)
            file["figures/force"].attrs["unit"] = "N"
            file["figures/none"] = np.full(40, np.nan)
            file["figures/none"].attrs["unit"] = "1"
        done = subprocess.run([ROOT / "scripts" / "picture", "--sweep", path], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.split(), [str(self.folder / "made-up-force.png")])

    def test_natural_frequencies(self):
        bar = studies.STEEL + """
[meshes.bar]
type = "box"
size = [0.4, 0.02, 0.02]
divisions = [40, 2, 2]
[parts.bar]
mesh = "bar"
material = "steel"
[constraints.clamp]
target = "bar.x_min"
fixed = ["x", "y", "z"]
[time]
end = 1e-6
"""
        study = write(
            self.folder,
            "[grid]\nmaterials.steel.youngs_modulus = [50e9, 200e9]\n[figures]\nfirst = \"mode.1.frequency\"\n"
            "none = \"mode.999.frequency\"\n[modes]\nup_to = 3000\n",
            bar,
        )
        done = sweep(study)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        soft, stiff = rows(study)
        # A frequency goes by the root of the modulus.
        self.assertAlmostEqual(float(stiff["first [Hz]"]) / float(soft["first [Hz]"]), 2, places=4)
        self.assertEqual(soft["none [Hz]"], "")
        self.assertFalse(any(member.joinpath("results.h5").exists() for member in members(study)))


class Fates(SweepTest):
    def test_one_that_breaks_down_or_is_refused_does_not_end_the_others(self):
        # The second is beyond a limit of the monitor at once; the third has a mistake that only its meshes reveal.
        study = write(
            self.folder,
            "[[list]]\ncontacts.between.friction = 0.1\n[[list]]\nmonitor.fatal_speed = 0.5\nmonitor.speed = 0.5\n"
            "[[list]]\ncontacts.between.slave = \"upper.z_nim\"\n[[list]]\ncontacts.between.friction = 0.2\n"
            + studies.FIGURES,
        )
        done = sweep(study)
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        table = rows(study)
        self.assertEqual(
            [row["status"] for row in table], ["completed", "broke down", "refused", "completed"], table
        )
        self.assertTrue(table[1]["reason"])
        self.assertIn("z_nim", table[2]["reason"])
        self.assertEqual(table[1]["heat [J]"], "")
        self.assertIn("2 completed, 1 broke down, 1 refused, 0 unfinished", done.stdout)
        attempts = [(member / "attempts.txt").read_text() for member in members(study)]
        self.assertEqual([text.count("began") for text in attempts], [1] * 4)
        self.assertEqual(sweep(study).returncode, 3)  # and they are not tried again
        self.assertEqual([(member / "attempts.txt").read_text() for member in members(study)], attempts)

    def start(self, study, *options):
        return subprocess.Popen(
            [PROGRAM, "sweep", study, "--no-pictures", *options], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            text=True, start_new_session=True,
        )

    def wait_for_run(self, process, study):
        """Until a member's run writes its results; its process."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            runs = children(process.pid)
            if runs and any((member / "results.h5").exists() for member in members(study)):
                return runs[0]
            time.sleep(0.002)
        self.fail("no member has begun")

    LONG = """
[common]
time.end = 1.5e-3
output.field_interval = 1e-3
[grid]
contacts.between.friction = [0.2]
[figures]
heat = "energy.friction"
"""

    def test_a_killed_member_is_tried_again(self):
        study = write(self.folder, self.LONG)
        (self.folder / "out" / "members").mkdir(parents=True)
        process = self.start(study)
        os.kill(self.wait_for_run(process, study), signal.SIGKILL)
        said, _ = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 0, said)
        self.assertIn("killed by signal 9 (Killed); it runs again", said)
        self.assertEqual(rows(study)[0]["status"], "completed")
        self.assertEqual(times_run(members(study)[0]), 1)

    def test_a_member_killed_too_often_is_left_and_tried_by_the_next_sweep(self):
        study = write(self.folder, self.LONG)
        (self.folder / "out" / "members").mkdir(parents=True)
        process = self.start(study, "--retries", "0")
        os.kill(self.wait_for_run(process, study), signal.SIGKILL)
        said, _ = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 1, said)
        self.assertEqual(rows(study)[0]["status"], "killed")
        self.assertIn("signal 9", rows(study)[0]["reason"])
        self.assertEqual(sweep(study).returncode, 0)
        self.assertEqual(rows(study)[0]["status"], "completed")

    def test_a_stopped_sweep_goes_on_from_checkpoints(self):
        study = write(self.folder, self.LONG)
        (self.folder / "out" / "members").mkdir(parents=True)
        process = self.start(study)
        self.wait_for_run(process, study)
        process.send_signal(signal.SIGTERM)
        said, _ = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 130, said)
        member = members(study)[0]
        self.assertTrue((member / "results.checkpoint.h5").exists(), said)
        self.assertEqual(rows(study)[0]["status"], "killed")
        done = sweep(study)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("goes on from", (member / "log.txt").read_text())
        self.assertFalse((member / "results.checkpoint.h5").exists())
        self.assertEqual(leftovers(study), [])

    def test_a_killed_sweep_leaves_nothing_running_and_goes_on(self):
        study = write(self.folder, self.LONG)
        (self.folder / "out" / "members").mkdir(parents=True)
        process = self.start(study)
        run = self.wait_for_run(process, study)
        process.kill()
        process.communicate(timeout=PATIENCE)
        done = sweep(study)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertFalse(is_running(run))
        self.assertEqual(times_run(members(study)[0]), 1)
        self.assertEqual(leftovers(study), [])

    def test_a_figure_that_no_run_can_have_is_said_before_the_first(self):
        wrong = "[grid]\ncontacts.between.friction = [0.2]\n[figures]\nheat = \"energy.frction\"\n"
        study = write(self.folder, wrong)
        for options in ((), ("--dry-run",), ("--slurm", "2"), ("--snakemake",)):
            done = sweep(study, *options)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn("study.toml:7: [figures] heat: ", done.stderr)
            self.assertIn("did you mean 'friction'?", done.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_figures_that_cannot_be_collected_keep_the_run(self):
        # Fields are written every 1e-5 s: none lies in between.
        between = "[figures]\narea = {of = \"patch.between.area\", from = 1.2e-5, to = 1.8e-5}\n"
        study = write(self.folder, "[grid]\ncontacts.between.friction = [0.2]\n" + between)
        done = sweep(study)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertEqual(rows(study)[0]["status"], "failed")
        self.assertIn("[figures] area", rows(study)[0]["reason"])
        write(self.folder, "[grid]\ncontacts.between.friction = [0.2]\n[figures]\nheat = \"energy.friction\"\n")
        self.assertEqual(sweep(study).returncode, 0)
        self.assertTrue(math.isfinite(float(rows(study)[0]["heat [J]"])))
        self.assertEqual(times_run(members(study)[0]), 1)


class OddStudies(SweepTest):
    """What a user does to a study, its case or its folder, and what must not come of it."""

    QUICK = "[common]\ntime.end = 5e-6\noutput.field_interval = 5e-6\n"

    def quick(self, text, **more):
        return write(self.folder, self.QUICK + text + HEAT, **more)

    def test_a_case_that_is_changed_while_members_run(self):
        study = write(self.folder, Fates.LONG.replace("[0.2]", "[0.2, 0.3]"))
        (self.folder / "out" / "members").mkdir(parents=True)
        case = self.folder / "case.toml"
        before = case.read_text()
        process = subprocess.Popen(
            [PROGRAM, "sweep", study, "--no-pictures", "--jobs", "1"], stdout=subprocess.PIPE, text=True
        )
        end = time.monotonic() + PATIENCE
        while not any((member / "results.h5").exists() for member in members(study)) and time.monotonic() < end:
            time.sleep(0.002)
        case.write_text(before.replace("velocity = [1, 0, 0]", "velocity = [9, 0, 0]"))
        said, _ = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 1, said)
        case.write_text(before)
        self.assertEqual({row["status"] for row in rows(study)}, {"failed"})
        self.assertIn("was changed after the sweep had begun", rows(study)[0]["reason"])
        # What ran is of nobody knows which case: no sweep takes it for the member's.
        done = sweep(study)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual({row["status"] for row in rows(study)}, {"completed"})
        self.assertEqual(len(members(study)), 2)

    def test_a_case_that_is_away_for_a_moment(self):
        study = write(self.folder, Fates.LONG.replace("[0.2]", "[0.2, 0.3]"))
        (self.folder / "out" / "members").mkdir(parents=True)
        process = subprocess.Popen(
            [PROGRAM, "sweep", study, "--no-pictures", "--jobs", "1"], stdout=subprocess.PIPE, text=True
        )
        end = time.monotonic() + PATIENCE
        while not any((member / "results.h5").exists() for member in members(study)) and time.monotonic() < end:
            time.sleep(0.002)
        (self.folder / "case.toml").rename(self.folder / "away.toml")
        process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 1)
        (self.folder / "away.toml").rename(self.folder / "case.toml")
        self.assertEqual(sweep(study).returncode, 0)

    def test_the_table_says_what_members_ran_with(self):
        case = studies.CASE.replace("velocity = [1, 0, 0]", "velocity = [1, 0.5, 0]")
        study = write(
            self.folder,
            "[common]\ntime.end = 5e-6\ninitial_motion.slide.velocity = [5, 0, 0]\n[[list]]\n"
            '"initial_motion.slide.velocity[0]" = 2\n'
            "[[list]]\ncontacts.between.friction = 0.30000000000000004\n" + HEAT,
            case,
        )
        self.assertEqual(sweep(study).returncode, 0)
        speed, friction = "initial_motion.slide.velocity[0] [m/s]", "contacts.between.friction"
        self.assertEqual([row[speed] for row in rows(study)], ["2", "5"])
        self.assertEqual(rows(study)[1][friction], "0.30000000000000004")

    def test_a_list_and_one_of_its_entries(self):
        study = self.quick(
            "[[list]]\ninitial_motion.slide.velocity = [2, 0, 0]\n"
            '[[list]]\n"initial_motion.slide.velocity[0]" = 4\n'
        )
        done = sweep(study)
        self.assertEqual(done.returncode, 0, done.stderr)
        heading = (self.folder / "out" / "sweep.csv").read_text().splitlines()[0].split(",")
        self.assertEqual(len(heading), len(set(heading)))
        self.assertEqual([row["initial_motion.slide.velocity[0] [m/s]"] for row in rows(study)], ["2", "4"])

    def test_damaged_results_are_made_again(self):
        study = self.quick("[grid]\ncontacts.between.friction = [0.2]\n")
        self.assertEqual(sweep(study).returncode, 0)
        member = members(study)[0]
        heat = rows(study)[0]["heat [J]"]
        results = (member / "results.h5").read_bytes()
        (member / "results.h5").write_bytes(results[: len(results) // 2])
        (member / "row.toml").unlink()
        done = sweep(study)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(times_run(member), 2)
        self.assertEqual(rows(study)[0]["heat [J]"], heat)

    def test_a_figure_that_is_added_and_cannot_be_had(self):
        study = self.quick("[grid]\ncontacts.between.friction = [0.2]\n")
        self.assertEqual(sweep(study).returncode, 0)
        study.write_text(
            study.read_text() + 'area = {of = "patch.between.area", from = 1e-6, to = 2e-6}\n'
        )
        self.assertEqual(sweep(study, "--collect").returncode, 1)
        self.assertIn("sweep again", rows(study)[0]["reason"])
        self.assertEqual(sweep(study).returncode, 1)
        self.assertEqual(rows(study)[0]["status"], "failed")
        self.assertIn("[figures] area", rows(study)[0]["reason"])

    def test_two_studies_of_one_name(self):
        for name in ("a", "b"):
            (self.folder / name).mkdir()
            study = write(self.folder / name, self.QUICK + "[grid]\ncontacts.between.friction = [0.2]\n" + HEAT)
            lines = study.read_text().splitlines(keepends=True)
            study.write_text("".join(line for line in lines if not line.startswith("folder")))
            done = subprocess.run(
                [PROGRAM, "sweep", study, "--no-pictures"], capture_output=True, text=True, cwd=self.folder
            )
            self.assertEqual(done.returncode, 0 if name == "a" else 2, done.stderr)
        self.assertIn("the table of another study, " + str(self.folder / "a" / "study.toml"), done.stderr)

    def test_files_in_the_way(self):
        study = self.quick("[grid]\ncontacts.between.friction = [0.2, 0.3, 0.4]\n")
        out = self.folder / "out"
        out.mkdir()
        (out / "sweep.csv").write_text("somebody's")
        done = sweep(study)
        self.assertEqual(done.returncode, 2)
        self.assertIn("move it away", done.stderr)
        self.assertFalse((out / "members").exists(), "said before anything runs")
        (out / "sweep.csv").unlink()
        self.assertEqual(sweep(study).returncode, 0)
        one, two, three = members(study)
        for member in (one, three):
            for path in member.iterdir():
                path.unlink()
        one.rmdir()
        one.write_text("a file")
        (three / "row.toml").write_text("somebody's")
        done = sweep(study)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual([row["status"] for row in rows(study)], ["not run", "completed", "failed"])
        self.assertIn("row.toml is", rows(study)[2]["reason"])
        self.assertEqual((three / "row.toml").read_text(), "somebody's")
        one.unlink()
        (three / "row.toml").unlink()
        self.assertEqual(sweep(study).returncode, 0)

    def test_odd_characters(self):
        study = self.quick("[grid]\ncontacts.between.friction = [0.2, 0.3]\n")
        text = study.read_text().replace('title = "blocks"', "title = 'in $, \\frac of $'")
        study.write_text(text.replace(f'folder = "{self.folder}/out"', f"folder = '{self.folder}/a \"b\\c'"))
        done = subprocess.run([PROGRAM, "sweep", study], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue((self.folder / 'a "b\\c' / "sweep-heat.png").exists(), done.stdout + done.stderr)

    def test_scripts(self):
        study = self.quick("[grid]\ncontacts.between.friction = [0.2]\n")
        study = study.rename(self.folder / "my study.toml")
        self.assertIn('--job-name="my study-members"', sweep(study, "--slurm", "2", "--dry-run").stdout)
        before = sweep(study, "--snakemake", "--dry-run").stdout
        study.write_text(study.read_text() + 'speed = "upper.z_max.velocity.x"\n')
        after = sweep(study, "--snakemake", "--dry-run").stdout
        changed = [line for line in after.splitlines() if line not in before.splitlines()]
        self.assertEqual([line.split("=")[0].strip() for line in changed], ["figures"])

    def test_mistakes(self):
        for text, said in (
            ("[grid]\ncontacts.between.friction = [0.2]\n[figures]\nreason = \"energy.friction\"\n", "column"),
            ("table = \"t.csv\"\n" + HEAT, "t.csv:3: the line has no value"),
        ):
            (self.folder / "t.csv").write_text("contacts.between.friction,time.end\n0.2,5e-6\n,\n")
            table = text.startswith("table")
            study = write(self.folder, text if table else self.QUICK + text)
            done = sweep(study)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(said, done.stderr)
        study = self.quick("[grid]\ncontacts.between.friction = [0.2]\n")
        self.assertEqual(sweep(study, "--collect", "--members", "1").returncode, 2)


class ExampleStudies(unittest.TestCase):
    def test_each_study_of_the_project_can_be_read(self):
        files = [path for folder in ("studies", "cases") for path in (ROOT / folder).rglob("*.toml")]
        found = [path for path in files if isinstance(tomllib.loads(path.read_text()).get("case"), str)]
        self.assertGreater(len(found), 0)
        with tempfile.TemporaryDirectory(prefix="railwave-") as folder:
            for study in found:
                with self.subTest(study=study):
                    done = subprocess.run(
                        [PROGRAM, "sweep", study, "--dry-run"], capture_output=True, text=True, cwd=folder
                    )
                    self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
