#!/usr/bin/env python3
"""Damaged results files: a handful of scripts/fuzz_results' damages, and those that once were findings. Each command
comes to its end with the sound file's output or refuses with a message that names the file."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
sys.path.insert(0, str(SOURCE / "scripts"))
try:
    import h5py
    from damage import sound, verdict
    from damage.damage import Damage
except ImportError:
    sys.exit(77)

DAMAGES = 60


def endless(data):
    first = data.index(b"GCOL") + 24
    return data[:first] + (2**64 - 16).to_bytes(8, "little") + data[first + 8 :]


class DamagedResults(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="railwave-")
        cls.folder = pathlib.Path(cls.temporary.name).resolve()
        cls.seeds = sound.make(PROGRAM, cls.folder / "sound")
        cls.commands = verdict.Commands(PROGRAM, cls.folder / "work")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def seed(self, name):
        return next(seed for seed in self.seeds if seed.name == name)

    def judged(self, number):
        damage = Damage(number)
        seed = damage.chance.choice(self.seeds)
        name = damage.chance.choice(sorted(seed.commands))
        data = damage.apply(seed.bytes)
        outcome = self.commands.judge(seed, name, data)
        self.assertFalse(
            outcome.finding,
            f"damage {number}, {name} on {seed.name}, {', '.join(damage.done)}: {outcome.kind}\n{outcome.text}",
        )
        return outcome.kind

    def test_some_damages(self):
        kinds = {self.judged(number) for number in range(7, 7 + DAMAGES)}
        self.assertIn("refused with a message", kinds)
        self.assertIn("as from the sound file", kinds)

    def test_every_chunk_has_a_checksum(self):
        def look(name, item):
            if isinstance(item, h5py.Dataset) and item.size:
                self.assertTrue(item.fletcher32, name)
        for name in ("contact", "symmetric", "hammer"):
            with h5py.File(self.seed(name).path, "r") as file:
                file.visititems(look)

    def test_a_flipped_bit_in_what_is_read_is_reported(self):
        """In each of the arrays that a command reads, and a chunk that was lost and reads as zeros."""
        seed = self.seed("hammer")
        with h5py.File(seed.path, "r") as file:
            group = file["history/set/bar.row_2"]
            chunk = file["history/set/bar.row_2/velocity"].id.get_chunk_info(0)
            place = group["position"].id.get_chunk_info(0)
        for at, length in ((chunk.byte_offset, chunk.size), (place.byte_offset, place.size)):
            for damaged in (bytes([seed.bytes[at + length // 2] ^ 4]), bytes(length)):
                data = bytearray(seed.bytes)
                first = at if len(damaged) > 1 else at + length // 2
                data[first : first + len(damaged)] = damaged
                if at == place.byte_offset:
                    answer = self.commands.run(seed, "signal speed FILE --channel bar.row_*.velocity.z", bytes(data))
                else:
                    answer = self.commands.run(seed, "signal psd FILE --channel bar.row_2.velocity.z", bytes(data))
                self.assertEqual(answer.code, 2, answer.complaint)
                self.assertIn("damaged.h5 is damaged", answer.complaint)

    def test_texts_in_a_destroyed_heap(self):
        """HDF5 crashes there (H5HG_read); texts have no checksum."""
        seed = self.seed("hammer")
        heap = seed.bytes.index(b"GCOL")
        for offset in range(8, 64, 4):
            data = bytearray(seed.bytes)
            data[heap + offset : heap + offset + 4] = b"\xff\xff\xff\x7f"
            for name in ("frf", "signal bandpass"):
                outcome = self.commands.judge(seed, name, bytes(data))
                self.assertFalse(outcome.finding, f"{name}, {offset}: {outcome.kind} {outcome.text}")

    def test_an_endless_loop_is_ended(self):
        """A text whose length leads HDF5 back to the same place of the heap, for ever."""
        seed = self.seed("hammer")
        outcome = self.commands.judge(seed, "frf", endless(seed.bytes))
        self.assertIn(outcome.kind, ("endless loop in HDF5, reported", "refused with a message"), outcome.text)

    def test_nothing_is_written_before_all_is_read(self):
        """The table was left where HDF5 crashed in the title, which goes into the second file."""
        seed = self.seed("contact")
        heap = seed.bytes.index(b"GCOL")
        size = int.from_bytes(seed.bytes[heap + 8 : heap + 16], "little")
        outcome = self.commands.judge(
            seed, "signal bandpass", seed.bytes[: heap + 8] + b"\xff" * (size - 8) + seed.bytes[heap + size :]
        )
        self.assertFalse(outcome.finding, outcome.kind + outcome.text)
        self.assertNotEqual(outcome.kind, "as from the sound file")

    def test_a_name_that_was_changed(self):
        """What asked for a set is a text, in which a flipped bit makes another name; and a channel that is gone is
        reported with the file's name."""
        seed = self.seed("hammer")
        for old, new in ((b"probe row", b"probe raw"), (b"hammer blow", b"hammer bloc"), (b"bar.blow", b"bar.row_")):
            old, new = (len(old).to_bytes(8, "little") + text for text in (old, new))  # as the heap has them
            self.assertTrue(old in seed.bytes)
            answer = self.commands.run(seed, "frf FILE", seed.bytes.replace(old, new))
            self.assertEqual(answer.code, 2, f"{old}: {answer.said}{answer.complaint}")
            self.assertIn("damaged.h5", answer.complaint)
        copy = self.folder / "copy.h5"
        sound.old_format(seed.path, copy)
        with h5py.File(copy, "a") as file:
            del file["history/set/bar.row_4"], file["history/set/bar.row_5"]
        answer = self.commands.run(seed, "signal speed FILE --channel bar.row_*.velocity.z", copy.read_bytes())
        self.assertEqual(answer.code, 2)
        self.assertIn("damaged.h5", answer.complaint)

    def test_a_restart_is_refused_before_it_computes(self):
        """Where what was written last is damaged, to which the run would add."""
        seed = self.seed("restart")
        with h5py.File(seed.path, "r") as file:
            chunk = file["history/energy/kinetic"].id.get_chunk_info(0)
        data = bytearray(seed.bytes)
        data[chunk.byte_offset + 100] ^= 1
        answer = self.commands.run(seed, seed.commands["run --restart"], bytes(data))
        self.assertEqual(answer.code, 2, answer.complaint)
        self.assertIn("--restart: the results results.h5 cannot be added to", answer.complaint)
        self.assertNotIn("step", answer.said)
        self.assertEqual((self.commands.folder / "results.h5").read_bytes(), bytes(data))

    def test_pictures_of_damaged_files(self):
        seed, script = self.seed("contact"), SOURCE / "scripts" / "picture"
        heap = seed.bytes.index(b"GCOL")
        for what, change in (
            ("cut short", lambda data: data[: len(data) // 2]),
            ("heap", lambda data: data[: heap + 8] + b"\xff" * 40 + data[heap + 48 :]),
            ("header", lambda data: data[:60] + b"\x55" + data[61:]),
            ("endless", endless),
        ):
            path = self.folder / "picture.h5"
            path.write_bytes(change(seed.bytes))
            done = subprocess.run(
                [
                    sys.executable, script, path, "--only", "forces", "--out", self.folder / "pictures", "--program",
                    PROGRAM,
                ],
                capture_output=True,
                text=True,
            )
            self.assertEqual(done.returncode, 2, f"{what}: {done.stderr}")
            self.assertIn("picture.h5", done.stderr)
            self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
