#!/usr/bin/env python3
"""Where scripts/hourglass_table writes its --csv, and where not."""
import importlib.machinery
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
SCRIPT = pathlib.Path(os.path.realpath(__file__)).parents[2] / "scripts" / "hourglass_table"
loader = importlib.machinery.SourceFileLoader("hourglass_table", str(SCRIPT))
hourglass_table = importlib.util.module_from_spec(importlib.util.spec_from_loader("hourglass_table", loader))
loader.exec_module(hourglass_table)
ROW = {column: f"{column} here" for column in hourglass_table.COLUMNS}


class Table(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.path = pathlib.Path(place.name) / "table.csv"

    def test_a_table_is_written_and_its_own_replaced(self):
        for rows in ([ROW], [ROW, ROW]):
            self.assertEqual(hourglass_table.why_not_written(str(self.path), False), "")
            hourglass_table.write_table(str(self.path), rows)
            self.assertEqual(len(self.path.read_text().splitlines()), 1 + len(rows))
        self.assertEqual([p.name for p in self.path.parent.iterdir()], ["table.csv"])

    def test_what_is_not_its_own_stays(self):
        self.path.write_text("my own figures\n")
        done = subprocess.run([sys.executable, SCRIPT, "--csv", self.path], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("this script did not write it", done.stderr)
        self.assertEqual(self.path.read_text(), "my own figures\n")
        self.assertEqual(hourglass_table.why_not_written(str(self.path), True), "")

    def test_folders_that_are_not_there_and_what_is_no_file(self):
        self.assertIn("there is no folder", hourglass_table.why_not_written(str(self.path / "deeper.csv"), False))
        self.assertIn("no regular file", hourglass_table.why_not_written(str(self.path.parent), True))


if __name__ == "__main__":
    unittest.main()
