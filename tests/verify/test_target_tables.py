#!/usr/bin/env python3
"""What scripts read of a table that a user gives (scripts/number_table.py): columns by name, numbers wholly understood
or refused."""
import os
import pathlib
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
sys.dont_write_bytecode = True
sys.path.insert(0, str(SOURCE / "scripts"))

from number_table import TableError, read_table  # noqa: E402

GOOD = [
    b"frequency,amplitude\n80,0.5\n100,1e-3\n",
    b"frequency;amplitude\r\n80;0.5\r\n\r\n100;1e-3\r\n",
    b"frequency\tamplitude\n80\t.5\n100\t+1E-3",
    b"\xef\xbb\xbf# measured\n\"frequency\",\"amplitude\",phase\n80,0.5,x\n# gap\n100,1e-3,y\n",
    b"amplitude, frequency\r0.5, 80\r1e-3, 100\r",
]
BAD = {
    b"frequency;amplitude\n80;0,5\n": (
        "table.csv:2: column 2 (amplitude): '0,5' has a comma in it: a decimal comma? then write 0.5"
    ),
    b"frequency,amplitude\n80,0,5\n": "table.csv:2: has 3 values, must have 2",
    b"frequency,amplitude\n80 Hz,1\n": "column 1 (frequency): '80 Hz' has something behind the number",
    b"frequency,amplitude\n80,nan\n": "'nan' is no finite decimal number",
    b"frequency,amplitude\n80,inf\n": "'inf' is no finite decimal number",
    b"frequency,amplitude\n80,1e400\n": "'1e400' is too large",
    b"frequency,amplitude\n80,0x10\n": "'0x10' has something behind the number",
    b"frequency,amplitude\n80,1_000\n": "'1_000' has something behind the number",
    b"frequency;amplitude\n80;1.000,5\n": "'1.000,5' has something behind the number",
    b"frequency,amplitude\n80,1.0.0\n": "'1.0.0' has something behind the number",
    b"frequency,amplitude\n80,\n": "'' is empty",
    b"frequency,amplitude\n80,1,\n": "has 3 values, must have 2",
    b"frequency,amplitude\n80,\"1\"\n": "stands in quotes",
    b"frequency,amplitude\nfrequency,amplitude\n": (
        "table.csv:2: column 1 (frequency): 'frequency' is no finite decimal number"
    ),
    b"frequency,level\n80,1\n": (
        "table.csv:1: the line of names is 'frequency,level', must have the column amplitude once"
    ),
    b"frequency,amplitude,amplitude\n80,1,2\n": "must have the column amplitude once",
    b"80,1\n": "must have the column frequency once",
    b"": "table.csv:1: is empty",
    "frequency,amplitude\n80,1\n".encode("utf-16"): "UTF-16",
    b"frequency,amplitude\n80,1\xb5\n": "table.csv:2: is no UTF-8 text",
}


class Tables(unittest.TestCase):
    def read(self, content):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "table.csv"
            path.write_bytes(content)
            return read_table(path, ["frequency", "amplitude"])

    def test_good(self):
        for content in GOOD:
            with self.subTest(content):
                self.assertEqual(
                    [(row["frequency"], row["amplitude"]) for row in self.read(content)], [(80, 0.5), (100, 1e-3)]
                )

    def test_bad(self):
        for content, wanted in BAD.items():
            with self.subTest(content):
                with self.assertRaises(TableError) as caught:
                    self.read(content)
                self.assertIn(wanted, str(caught.exception))

    def test_nothing_asks_the_locale(self):
        for path in [*(SOURCE / "src").rglob("*.[ch]pp"), *(SOURCE / "kernels").rglob("*.hpp")]:
            text = path.read_text(encoding="utf-8")
            for word in (
                "strtod(",
                "strtof(",
                "std::stod",
                "std::stof",
                "atof(",
                "sscanf(",
                "setlocale",
                "std::locale",
                ":L}",
            ):
                self.assertNotIn(word, text, path)


unittest.main()
