"""scripts/contact_pareto: which runs are on a front, tables of several machines as one, runs that fail or have no time
left, and what it refuses. Its runs are those of verify_contact, which test_long_contact_cases.py does."""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
SCRIPT = SOURCE / "scripts" / "contact_pareto"
sys.path.insert(0, str(SOURCE / "scripts"))
from verification.pareto import COLUMNS, Job, METHODS, Method, plan  # noqa: E402
from verification.pareto_table import joined, work_of  # noqa: E402


def row(method, elements, wall, peak, area, device="A", scene="hertz", approach=0.0):
    values = dict.fromkeys(COLUMNS, "")
    values.update(zip(COLUMNS, Job(scene, Method.named(method), elements).key))
    values.update(status="done", wall_s=wall, settling_s=wall, step_s=1e-7, element_steps_per_s=1e7,
                  elements=1000, settling_evaluations=500, steps=int(1500 / wall), peak_pressure_error=peak,
                  area_error=area, approach_error=approach, device=device)
    return values


class Pareto(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def table(self, name, rows):
        with open(self.folder / name, "w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS)
            writer.writeheader()
            writer.writerows(rows)
        return str(self.folder / name)

    def call(self, *arguments):
        return subprocess.run([sys.executable, SCRIPT, "--out", self.folder / "out", *arguments],
                              capture_output=True, text=True, check=False)

    def rows_of(self, name):
        with open(self.folder / "out" / name, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def test_methods_have_names_and_overrides(self):
        for method in METHODS:
            self.assertEqual(Method.named(method.name), method)
        growing = Method.named("penalty-2-growth").overrides("c", 1e-3)
        self.assertEqual(growing, ["contacts.c.algorithm=penalty", "contacts.c.penalty_scale=2",
                                   "contacts.c.penalty_growth=[[0,1],[2.5e-06,4]]"])
        for wrong in ("penalty", "penalty-0", "penalty--1", "penalty-2-growing", "multiplier-2", "penalty-1.2.3"):
            with self.subTest(wrong), self.assertRaises(ValueError):
                Method.named(wrong)

    def test_cheap_runs_come_first(self):
        jobs = plan(["rolling", "hertz"], METHODS, [20, 4, 10])
        self.assertEqual((jobs[0].scene, jobs[0].elements, jobs[-1].elements), ("hertz", 4, 20))
        self.assertEqual(len(jobs), 2 * 3 * len(METHODS))

    def test_a_front_has_what_no_other_run_beats_in_both(self):
        rows = [row("multiplier", 4, 1.0, 0.05, 0.01), row("multiplier", 6, 2.0, 0.02, 0.03),
                row("penalty-1", 4, 1.5, -0.10, 0.005), row("penalty-1", 6, 3.0, -0.03, 0.05),
                row("penalty-1", 10, 1.0, 0.05, 0.02)]
        other = [row("penalty-1", 4, 9.0, 0.5, 0.5, device="B")]
        found = joined([self.table("a.csv", rows), self.table("b.csv", other)])
        fronts = {(r["device"], r["algorithm"], r["elements_across"]): r["front"].split() for r in found}
        # Of two that take as long the one with less error, and both where that is the same.
        self.assertIn("peak", fronts["A", "multiplier", "4"])
        self.assertIn("peak", fronts["A", "penalty", "10"])
        self.assertIn("area", fronts["A", "multiplier", "4"])
        self.assertNotIn("area", fronts["A", "penalty", "10"])
        self.assertIn("area", fronts["A", "penalty", "4"])
        self.assertNotIn("peak", fronts["A", "penalty", "4"])
        self.assertIn("peak", fronts["A", "multiplier", "6"])
        self.assertFalse({"peak", "area", "worst"} & set(fronts["A", "penalty", "6"]))
        self.assertIn("worst", fronts["B", "penalty", "4"])  # another machine's is another front
        self.assertAlmostEqual(found[1]["worst_error"], 0.5)  # 2 of 4 %, 3 of 6 %
        self.assertAlmostEqual(found[1]["worst_error_of_twenty"], 1.0)

    def test_element_evaluations_may_count_in_place_of_time(self):
        table = self.table("a.csv", [row("multiplier", 4, 1.0, 0.05, 0.01), row("penalty-1", 4, 3.0, 0.06, 0.02)])
        by_time, by_work = joined([table]), joined([table], work_of)
        self.assertEqual([r["cost"] for r in by_time], [1.0, 3.0])
        self.assertEqual([r["cost"] for r in by_work], [2e6, 1e6])
        self.assertNotIn("peak", by_time[1]["front"].split())
        self.assertIn("peak", by_work[1]["front"].split())  # fewer evaluations
        done = self.call("--join", table, "--work")
        self.assertIn("| penalty, f_SI 1 | 4 | 1 M |", done.stdout)

    def test_tables_are_joined_with_pictures(self):
        first = self.table("a.csv", [row("multiplier", n, n, 0.1 / n, 0.1 / n) for n in (4, 10, 20)])
        second = self.table("b.csv", [row("penalty-2", n, n, 0.4 / n, 0.4 / n, "B") for n in (4, 10, 20)])
        done = self.call("--join", first, second)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("| multipliers | +1.0 / +1.0 / +0.0 % | 10 s | 4 s, 4 elements | 10 s, 10 elements |",
                      done.stdout)
        self.assertIn("| penalty, f_SI 2 | +4.0 / +4.0 / +0.0 % | 10 s | 10 s, 10 elements | 20 s, 20 elements |",
                      done.stdout)
        self.assertEqual(len(self.rows_of("joined.csv")), 6)
        self.assertEqual({p.name for p in (self.folder / "out").glob("*.png")},
                         {"pareto-hertz-a.png", "pareto-hertz-b.png"})

    def test_tables_that_cannot_be_joined_are_refused(self):
        good = self.table("good.csv", [row("multiplier", 4, 1, 0.1, 0.1)])
        (self.folder / "other.csv").write_text("a,b\n1,2\n", encoding="utf-8")
        with open(good, encoding="utf-8") as file:
            (self.folder / "short.csv").write_text(file.read().rsplit(",", 3)[0] + "\n", encoding="utf-8")
        for tables, said in (
            ((good, self.table("again.csv", [row("multiplier", 4, 2, 0.1, 0.1)])), "both have multiplier, 4 elements"),
            ((self.folder / "other.csv",), "is no table of scripts/contact_pareto"),
            ((self.folder / "short.csv",), "more or fewer values"),
            ((self.table("nan.csv", [row("multiplier", 4, 1, "nan", 0.1)]),), "a number that is none"),
            ((self.table("none.csv", [dict(row("multiplier", 4, 1, 0.1, 0.1), status="failed: so")]),),
             "no run is done"),
            ((self.folder / "missing.csv",), "No such file"),
        ):
            with self.subTest(said):
                done = self.call("--join", *tables)
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertIn(said, done.stderr)
                self.assertNotIn("Traceback", done.stderr)
                self.assertFalse((self.folder / "out").exists())

    def test_a_failed_run_is_in_the_table_and_the_others_go_on(self):
        done = self.call("--program", "false", "--elements", "4", "--only", "multiplier", "penalty-1")
        self.assertEqual(done.returncode, 1)
        rows = self.rows_of("runs.csv")
        self.assertEqual(len(rows), 4)
        for one in rows:
            self.assertIn("failed: railwave ended with 1", one["status"])

    def test_no_run_begins_when_the_time_is_over(self):
        done = self.call("--program", "false", "--elements", "4", "--only", "multiplier", "--seconds", "1e-9")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("not begun", done.stdout)
        self.assertFalse((self.folder / "out" / "runs.csv").exists())

    def test_mistakes_in_options_are_refused(self):
        for wrong, said in ((["--elements", "3"], "less than 4"), (["--only", "springs"], "is no method"),
                            (["--program", "no-such"], "there is no program"), (["--seconds", "nan"], "above 0"),
                            (["--jobs", "0"], "less than 1"), (["--scenes", "carter"], "invalid choice"),
                            (["--processor-time", "--threads", "2"], "needs --threads 1")):
            with self.subTest(wrong):
                done = self.call(*wrong)
                self.assertNotEqual(done.returncode, 0)
                self.assertIn(said, done.stderr)
                self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
