"""`railwave import` as people call it: files and where they go, what is replaced, messages and exit codes; every case
that it writes passes `railwave check` and runs. scripts/try_decks on a folder of such decks."""

import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
PROGRAM = os.path.join(os.environ["RAILWAVE_BIN_DIR"], "railwave")
DATA = ROOT / "tests/deck/data"
UNITS = {"everything.k": "mm,kg,ms", "everything.inp": "mm,t,s", "long.k": "m,kg,s"}


class Import(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def call(self, *words):
        return subprocess.run([PROGRAM, *map(str, words)], cwd=self.path, capture_output=True, text=True, check=False)

    def files(self):
        return sorted(path.name for path in self.path.iterdir())

    def test_cases_of_all_decks_run(self):
        for name, units in UNITS.items():
            with self.subTest(deck=name):
                done = self.call("import", DATA / name, "--units", units, "--out", "case.toml", "--overwrite")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn("case.import.txt", done.stdout)
                for command in ("check", "run"):
                    done = self.call(command, "case.toml", *(["--overwrite"] if command == "run" else []))
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_files_lie_beside_the_case(self):
        self.assertEqual(self.call("import", DATA / "long.k").returncode, 0)
        self.assertEqual(self.files(), ["long.import.txt", "long.inp", "long.toml"])
        report = (self.path / "long.import.txt").read_text(encoding="utf-8").splitlines()
        self.assertTrue(all(line.startswith(str(DATA / "long.k")) for line in report[1:]))
        self.assertTrue(any("*SECTION_SOLID: replaced: ELFORM 2" in line for line in report))

    def test_the_report_has_every_keyword(self):
        done = self.call("import", DATA / "everything.k", "--units", UNITS["everything.k"])
        self.assertEqual(done.returncode, 0, done.stderr)
        report = (self.path / "everything.import.txt").read_text(encoding="utf-8")
        said = {int(line) for line in re.findall(r"everything\.k:(\d+): ", report)}
        lines = (DATA / "everything.k").read_text(encoding="ascii").splitlines()
        keywords = [number for number, line in enumerate(lines, 1) if line.startswith("*")]
        for begin, end in zip(keywords, keywords[1:]):
            with self.subTest(keyword=lines[begin - 1]):
                self.assertTrue(said & set(range(begin, end)))
        self.assertIn("*SET_PART_LIST: dropped: nothing that is taken uses it", report)

    def test_a_case_that_was_edited_stays(self):
        self.assertEqual(self.call("import", DATA / "long.k").returncode, 0)
        self.assertEqual(self.call("import", DATA / "long.k").returncode, 0)  # nothing changes
        case = self.path / "long.toml"
        case.write_text(case.read_text() + "# mine\n")
        done = self.call("import", DATA / "long.k")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--overwrite", done.stderr)
        self.assertIn("# mine", case.read_text())
        self.assertEqual(self.call("import", DATA / "long.k", "--overwrite").returncode, 0)
        self.assertNotIn("# mine", case.read_text())

    def test_names_and_titles_of_any_letters(self):
        text = (DATA / "long.k").read_bytes()
        (self.path / "träger 1.k").write_bytes(text.replace(b"a cube", b"W\xfcrfel"))  # the title in Latin 1
        done = self.call("import", "träger 1.k")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("träger 1.inp", (self.path / "träger 1.toml").read_text(encoding="utf-8"))
        self.assertEqual(self.call("check", "träger 1.toml").returncode, 0)

    def test_files_of_others_stay(self):
        (self.path / "long.inp").write_text("*NODE\n")
        done = self.call("import", DATA / "long.k")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(self.files(), ["long.inp"])
        self.assertEqual((self.path / "long.inp").read_text(), "*NODE\n")

    def test_the_deck_is_never_replaced(self):
        deck = self.path / "model.inp"
        deck.write_bytes((DATA / "everything.inp").read_bytes())
        self.assertEqual(self.call("import", "model.inp", "--units", "mm,t,s").returncode, 0)
        self.assertEqual(deck.read_bytes(), (DATA / "everything.inp").read_bytes())
        self.assertIn("model_mesh.inp", self.files())
        done = self.call("import", "model.inp", "--units", "mm,t,s", "--out", "model.inp", "--overwrite")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(deck.read_bytes(), (DATA / "everything.inp").read_bytes())

    def test_a_refusal_writes_nothing(self):
        text = (DATA / "long.k").read_text()
        broken = {
            "shells": (text.replace("*END", "*ELEMENT_SHELL\n2,1,1,2,3,4\n*END"), "shells.k:26: *ELEMENT_SHELL"),
            "ratio": (text.replace("       0.3 ", "       0.7 "), "poissons_ratio: is 0.7"),
            "empty": ("", "no"),
            "binary": ("\x00\x01\x02", "isn't a text file"),
        }
        for name, (deck, expected) in broken.items():
            with self.subTest(deck=name):
                (self.path / f"{name}.k").write_text(deck)
                done = self.call("import", f"{name}.k")
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertIn(expected, done.stderr)
                self.assertNotIn(f"{name}.toml", self.files())
        done = self.call("import", "shells.k", "--drop", "ELEMENT_SHELL", "--drop", "NOTHING_OF_IT")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("--drop NOTHING_OF_IT met nothing", done.stdout)
        self.assertIn("as --drop asks", (self.path / "shells.import.txt").read_text())

    def test_try_decks(self):
        decks = self.path / "decks/more"
        decks.mkdir(parents=True)
        (decks / "good.k").write_bytes((DATA / "long.k").read_bytes())
        (decks / "mm.key").write_bytes((DATA / "everything.k").read_bytes())
        (decks / "bad.dyn").write_text("*KEYWORD\n*NODE\n1,x\n")
        (decks / "none.k").write_text("no deck at all\n")
        table = self.path / "table.csv"
        done = subprocess.run(
            [sys.executable, ROOT / "scripts/try_decks", self.path / "decks", "--program", PROGRAM, "--csv", table],
            capture_output=True, text=True, check=False,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("3 decks: 2 read, 1 refused, 0 failed", done.stdout)
        with open(table, encoding="utf-8") as file:
            rows = {row["deck"]: row for row in csv.DictReader(file)}
        self.assertEqual(rows["more/bad.dyn"]["line"], "3")
        self.assertEqual(rows["more/mm.key"]["units"], "mm,kg,ms")
        done = subprocess.run(
            [sys.executable, ROOT / "scripts/try_decks", self.path / "decks", "--program", "/bin/false"],
            capture_output=True, text=True, check=False,
        )
        self.assertEqual(done.returncode, 1)


if __name__ == "__main__":
    unittest.main()
