#!/usr/bin/env python3
"""Nothing that a user owns is destroyed: every kind of file that may lie where a command is asked to write, by every
option that names a file to write. Whatever happens, everything in the folder is as it was, but for what the rule of
docs/faults.md ("Who may write where") lets be replaced."""

import os
import pathlib
import shutil
import socket
import stat
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
    import numpy
except ImportError:
    sys.exit(77)

PROGRAM = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]) / "railwave"
MESH = """*NODE
1, 0, 0, 0
2, 10, 0, 0
3, 10, 10, 0
4, 0, 10, 0
5, 0, 0, 10
6, 10, 0, 10
7, 10, 10, 10
8, 0, 10, 10
*INCLUDE, INPUT=elements.inp
"""
ELEMENTS = "*ELEMENT, TYPE=C3D8R, ELSET=ALL\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
CASE = """
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.lower]
type = "file"
path = "cube.inp"
scale = 0.001
[meshes.upper]
type = "box"
size = [0.01, 0.01, 0.01]
[parts.lower]
mesh = "lower"
material = "steel"
[parts.upper]
mesh = "upper"
material = "steel"
position = [0, 0, 0.010001]
[constraints.floor]
target = "lower.exterior"
fixed = ["x", "y", "z"]
[contacts.between]
slave = "upper.z_min"
master = "lower.exterior"
[curves.push]
type = "table"
file = "push.csv"
[loads.push]
type = "pressure"
target = "upper.z_max"
pressure = 1e5
curve = "push"
[hammers.blow]
part = "upper"
position = [0.005, 0.005, 0.020001]
direction = [0, 0, -1]
peak = 100
duration = 2e-6
[time]
end = 4e-6
[output]
file = "run.h5"
field_sets = ["upper"]
fields = ["displacement"]
history_sets = ["upper.z_max"]
"""
# Each way to name a file that a command writes: the words before it. `{}` is the path.
RUN = ["run", "case.toml", "--set", "time.end=4e-6"]
COMMANDS = {
    "run output.file": [*RUN, "--set", "output.file={}"],
    "run checkpoint.file": [*RUN, "--set", "output.file=made/new.h5", "--set", "checkpoint.file={}"],
    "mesh --out": ["mesh", "case.toml", "--out", "{}"],
    "modes --out": ["modes", "case.toml", "--up-to", "1e6", "--out", "{}"],
    "modes --csv": ["modes", "case.toml", "--up-to", "1e6", "--csv", "{}"],
    "contact --csv": ["contact", "own.h5", "--csv", "{}"],
    "contact --nodes": ["contact", "own.h5", "--nodes", "{}"],
    "contact --cuts": ["contact", "own.h5", "--cuts", "{}"],
    "contact --hdf5": ["contact", "own.h5", "--hdf5", "{}"],
    "export --out": ["export", "own.h5", "--vtkhdf", "--out", "{}"],
    "frf --csv": ["frf", "own.h5", "--resolution", "1e5", "--from", "1", "--to", "1e6", "--csv", "{}"],
    "frf --hdf5": ["frf", "own.h5", "--resolution", "1e5", "--from", "1", "--to", "1e6", "--hdf5", "{}"],
    "decay --csv": ["decay", "own.h5", "--csv", "{}"],
    "decay --hdf5": ["decay", "own.h5", "--hdf5", "{}"],
    "signal --csv": ["signal", "psd", "own.h5", "--channel", "energy.kinetic", "--csv", "{}"],
    "signal --hdf5": ["signal", "psd", "own.h5", "--channel", "energy.kinetic", "--hdf5", "{}"],
}
if (pathlib.Path(os.environ["RAILWAVE_SOURCE_DIR"]) / "build" / "report" / "report.html").is_file():
    COMMANDS["report --out"] = ["report", "own.h5", "--out", "{}"]
INPUTS = {
    "run": ("case.toml", "cube.inp", "elements.inp", "push.csv"),
    "mesh": ("case.toml", "cube.inp", "elements.inp", "push.csv"),
    "modes": ("case.toml", "cube.inp", "elements.inp", "push.csv"),
}
XDMF = '<?xml version="1.0" ?>\n<Xdmf Version="3.0"><Domain/></Xdmf>\n'


def run(folder, words):
    environment = dict(os.environ, OMP_NUM_THREADS="1", OMP_PROC_BIND="false", OMP_WAIT_POLICY="passive")
    return subprocess.run(
        [PROGRAM, *words], cwd=folder, env=environment, capture_output=True, text=True, timeout=60, check=False
    )


def made_up_device(path):
    """A node of a null device of our own; false where that is not allowed."""
    try:
        os.mknod(path, stat.S_IFCHR | 0o600, os.makedev(1, 3))
    except OSError:
        return False
    return True


def furnish(folder, own):
    """The folder of a careless user: a case with its inputs, results and all sorts of other things. Returns the
    names."""
    (folder / "case.toml").write_text(CASE)
    (folder / "cube.inp").write_text(MESH)
    (folder / "elements.inp").write_text(ELEMENTS)
    (folder / "push.csv").write_text("0, 0\n1e-3, 1\n")
    for name in own.iterdir():
        if name.is_file():
            shutil.copy2(name, folder / name.name)
    (folder / "notes.txt").write_text("three weeks of notes\n")
    (folder / "table.csv").write_text("time,force\n0,1\n")
    (folder / "frequencies.csv").write_text("frequency,rail.top\n0,1\n")
    with h5py.File(folder / "foreign.h5", "w") as file:
        file["measured"] = numpy.arange(100.0)
        file.attrs["format"] = "somebody's"
    shutil.copy(folder / "own.h5", folder / "cut.h5")
    os.truncate(folder / "cut.h5", 40)
    (folder / "fields.xdmf").write_text(XDMF)
    (folder / "measured.h5").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(200))
    (folder / "picture.png").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(range(200)))
    (folder / "empty").touch()
    (folder / "protected.h5").write_bytes((folder / "own.h5").read_bytes())
    (folder / "protected.h5").chmod(0o444)
    (folder / "a folder").mkdir()
    (folder / "a folder" / "thing.txt").write_text("in it")
    (folder / "made").mkdir()
    os.mkfifo(folder / "pipe")
    door = socket.socket(socket.AF_UNIX)
    here = os.open(".", os.O_RDONLY)
    os.chdir(folder)  # a socket's path may not be long
    door.bind("socket")
    os.fchdir(here)
    os.close(here)
    door.close()
    os.link(folder / "case.toml", folder / "hard.toml")
    for target in ("notes.txt", "case.toml", "own.h5", "foreign.h5", "a folder", "pipe"):
        (folder / f"link to {target}").symlink_to(target)
    (folder / "circle").symlink_to("circle")
    (folder / "link to nowhere").symlink_to("no folder/file")
    names = [
        "case.toml", "cube.inp", "elements.inp", "push.csv", "own.h5", "own.xdmf", "notes.txt", "table.csv",
        "frequencies.csv", "foreign.h5", "cut.h5", "fields.xdmf", "measured.h5", "picture.png", "empty", "protected.h5",
        "a folder", "pipe", "socket", "hard.toml", "link to notes.txt", "link to case.toml", "link to own.h5",
        "link to foreign.h5", "link to a folder", "link to pipe", "circle", "link to nowhere", "no folder/file",
        "a folder/", "",
    ]
    if made_up_device(folder / "device"):
        names.append("device")
    return names


def picture(folder):
    """What lies there, without opening what is not a regular file: {path: what}."""
    found = {}
    for path in sorted(folder.rglob("*")):
        facts = path.lstat()
        name = str(path.relative_to(folder))
        if stat.S_ISLNK(facts.st_mode):
            found[name] = ("link", os.readlink(path))
        elif stat.S_ISREG(facts.st_mode):
            found[name] = ("file", facts.st_ino, stat.S_IMODE(facts.st_mode), path.read_bytes())
        else:
            found[name] = (stat.S_IFMT(facts.st_mode), facts.st_ino)
    return found


class NothingDestroyed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="railwave-")
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.own = pathlib.Path(cls.scratch.name) / "own"
        cls.own.mkdir()
        for name, text in (
            ("case.toml", CASE),
            ("cube.inp", MESH),
            ("elements.inp", ELEMENTS),
            ("push.csv", "0, 0\n1e-3, 1\n"),
        ):
            (cls.own / name).write_text(text)
        done = run(cls.own, ["run", "case.toml", "--set", "output.file=own.h5"])
        assert done.returncode == 0, done.stdout + done.stderr

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="railwave-", dir=self.scratch.name)
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.names = furnish(self.folder, self.own)

    def words(self, command, path, *options):
        return [word.replace("{}", path) for word in COMMANDS[command]] + list(options)

    def test_without_overwrite(self):
        """Everything is refused, before any work, but own results by a run: none of these is of the kind that the
        command writes."""
        before, count = picture(self.folder), 0
        for command in COMMANDS:
            for name in self.names:
                if command == "run output.file" and name in ("own.h5", "link to own.h5"):
                    continue
                with self.subTest(command=command, file=name):
                    done = run(self.folder, self.words(command, name))
                    count += 1
                    self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                    self.assertTrue(done.stderr.startswith("railwave: "), done.stderr)
                    self.assertEqual(done.stdout, "")
                    self.assertIn(name, done.stderr)
                    self.assertEqual(picture(self.folder), before)
        print(f"{count} combinations of kind of file and command without --overwrite: nothing changed", file=sys.stderr)
        self.assertGreaterEqual(count, 200)

    def test_inputs_and_what_is_no_file_even_with_overwrite(self):
        before, count = picture(self.folder), 0
        others = [
            "a folder", "pipe", "socket", "circle", "link to a folder", "link to pipe", "link to nowhere",
            "no folder/file", "a folder/", "",
        ]
        others += ["device"] if "device" in self.names else []
        for command in COMMANDS:
            own = INPUTS.get(command.split()[0], ("own.h5",))
            own = own + ("hard.toml", "link to case.toml") if "case.toml" in own else own + ("link to own.h5",)
            for name in [*own, *others]:
                with self.subTest(command=command, file=name):
                    done = run(self.folder, self.words(command, name, "--overwrite"))
                    count += 1
                    after = picture(self.folder)
                    if name == "elements.inp":  # known as an input only when the mesh has been read
                        self.assertIn(done.returncode, (1, 2), done.stdout + done.stderr)
                        after = {path: what for path, what in after.items() if path in before}
                        for path in self.folder.rglob("*"):
                            if str(path.relative_to(self.folder)) not in before:
                                path.unlink()
                    else:
                        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                        self.assertNotIn("by --overwrite", done.stderr)
                    self.assertTrue(done.stderr.startswith("railwave: "), done.stderr)
                    self.assertEqual(after, before)
        print(
            f"{count} combinations of input or no file and command with --overwrite: nothing changed", file=sys.stderr
        )

    def test_overwrite_replaces_what_it_names_and_nothing_else(self):
        count = 0
        files = [
            "notes.txt", "table.csv", "foreign.h5", "cut.h5", "fields.xdmf", "picture.png", "empty", "protected.h5",
            "link to notes.txt", "link to foreign.h5",
        ]
        for command in COMMANDS:
            if command.startswith("decay"):
                continue  # wants a row of probes
            for name in files:
                if name == "fields.xdmf" and command.endswith(("--out", "output.file")):
                    continue  # it would be its own companion
                with self.subTest(command=command, file=name), tempfile.TemporaryDirectory(
                    prefix="railwave-", dir=self.scratch.name
                ) as place:
                    folder = pathlib.Path(place)
                    furnish(folder, self.own)
                    before = picture(folder)
                    done = run(folder, self.words(command, name, "--overwrite"))
                    count += 1
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                    after = picture(folder)
                    target = name.replace("link to ", "")
                    stem = os.path.splitext(name)[0]
                    may = {target, f"{stem}.xdmf"}
                    changed = {path for path in before if after.get(path) != before[path]}
                    self.assertEqual(changed - may, set())
                    if not command.startswith("run checkpoint"):  # that goes at the run's end
                        self.assertIn(target, changed)
                    # Again, now without it: these are this program's.
                    if name not in ("protected.h5",) and not command.startswith("run checkpoint"):
                        done = run(folder, self.words(command, name))
                        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                    self.assertEqual(
                        [path.name for path in folder.rglob("*.new*")] + [path.name for path in folder.rglob("*.lock")],
                        [],
                    )
        print(
            f"{count} combinations of kind of file and command with --overwrite: nothing else changed", file=sys.stderr
        )

    def test_companions_and_siblings(self):
        """What lies beside the named file is not replaced either."""
        for command, named, beside in (
            (
                "run output.file",
                "a.h5",
                ("a.xdmf", "a.fault.h5", "a.fault.xdmf", "a.checkpoint.h5", "a.checkpoint.h5.previous"),
            ),
            ("run checkpoint.file", "c.h5", ("c.h5.previous",)),
            ("mesh --out", "m.h5", ("m.xdmf",)),
            ("modes --out", "m.h5", ("m.xdmf",)),
        ):
            for name in beside:
                with self.subTest(command=command, beside=name):
                    (self.folder / name).write_text("somebody's")
                    before = picture(self.folder)
                    done = run(self.folder, self.words(command, named))
                    self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                    self.assertIn(name, done.stderr)
                    self.assertEqual(picture(self.folder), before)
                    (self.folder / name).unlink()

    def test_names_used_for_a_while(self):
        """Unfinished files of others stay, and the command does its work."""
        for command in ("run output.file", "mesh --out", "modes --out", "contact --hdf5", "signal --hdf5"):
            with self.subTest(command=command):
                for name in ("w.h5.new", "w.checkpoint.h5.new"):
                    (self.folder / name).write_text("somebody's")
                done = run(self.folder, self.words(command, "w.h5"))
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertEqual((self.folder / "w.h5.new").read_text(), "somebody's")
                self.assertEqual((self.folder / "w.checkpoint.h5.new").read_text(), "somebody's")
                for path in self.folder.glob("w.*"):
                    path.unlink()

    def test_a_lock_of_somebody_else(self):
        (self.folder / "w.h5.lock").write_text("somebody's")
        done = run(self.folder, self.words("run output.file", "w.h5"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("w.h5.lock", done.stderr)
        self.assertEqual((self.folder / "w.h5.lock").read_text(), "somebody's")

    def test_one_path_twice(self):
        before = picture(self.folder)
        (self.folder / "sub").mkdir()
        (self.folder / "link").symlink_to("sub")
        before = picture(self.folder)
        for words in (
            ["contact", "own.h5", "--csv", "a.csv", "--nodes", "a.csv"],
            ["contact", "own.h5", "--csv", "sub/a.csv", "--cuts", "link/../sub/a.csv"],
            ["contact", "own.h5", "--csv", "./a.csv", "--hdf5", "a.csv"],
            ["modes", "case.toml", "--csv", "a.h5", "--out", "a.h5"],
            ["modes", "case.toml", "--csv", "a.xdmf", "--out", "a.h5"],
            ["mesh", "case.toml", "--out", "m.xdmf"],
            ["signal", "psd", "own.h5", "--channel", "energy.kinetic", "--csv", "a.h5.new", "--hdf5", "a.h5"],
            [*RUN, "--set", "output.file=a.xdmf"],
            [*RUN, "--set", "output.file=a.h5", "--set", "checkpoint.file=sub/../a.h5"],
            [*RUN, "--set", "output.file=a.h5", "--set", "checkpoint.file=a.fault.h5"],
            [*RUN, "--set", "output.file=a.h5", "--set", "checkpoint.file=a.xdmf"],
            [*RUN, "--set", "output.file=a.h5", "--set", "checkpoint.file=a.h5.new"],
        ):
            for more in ([], ["--overwrite"]):
                with self.subTest(words=words, more=more):
                    done = run(self.folder, [*words, *more])
                    self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                    self.assertIn("name another file", done.stderr)
                    self.assertEqual(picture(self.folder), before)

    def test_dangling_links_make_their_target(self):
        (self.folder / "sub").mkdir()
        for command, made in (
            ("run output.file", "sub/x.h5"),
            ("mesh --out", "sub/x.h5"),
            ("contact --csv", "sub/x.csv"),
            ("contact --hdf5", "sub/y.h5"),
        ):
            with self.subTest(command=command):
                link = self.folder / ("new" + pathlib.Path(made).suffix)
                link.symlink_to(made)
                for _ in range(2):
                    done = run(self.folder, self.words(command, link.name))
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                    self.assertTrue(link.is_symlink())
                    self.assertTrue((self.folder / made).is_file())
                (self.folder / made).unlink()
                for path in self.folder.glob("new.*"):
                    path.unlink()

    def test_inputs_that_are_no_files(self):
        """Neither waited for nor read."""
        kinds = ["pipe", "socket", "a folder", "link to pipe"] + (["device"] if "device" in self.names else [])
        for name in kinds:
            commands = [
                ["run", name],
                ["check", name],
                ["mesh", name],
                ["modes", name],
                ["contact", name],
                ["frf", name],
                ["decay", name],
                ["signal", "psd", name, "--channel", "energy.kinetic"],
                ["run", "case.toml", "--set", f"curves.push.file={name}"],
                ["run", "case.toml", "--set", f"meshes.lower.path={name}"],
                ["run", "case.toml", "--restart", "--set", f"output.file={name}"],
                ["run", "case.toml", "--restart", "--set", "output.file=own.h5", "--set", f"checkpoint.file={name}"],
            ]
            for words in commands:
                with self.subTest(words=words):
                    done = run(self.folder, words)
                    self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                    self.assertIn(name, done.stderr)

    def test_a_settled_state_of_somebody_else(self):
        settle = ["--set", "settle.method=newton", "--set", "contacts.between.friction=0.1"]
        done = run(self.folder, [*RUN, "--set", "output.file=w.h5", *settle])
        kept = list(self.folder.glob("settled-*.h5"))
        if done.returncode != 0 or not kept:
            self.skipTest("the scene does not settle: " + done.stderr)
        for path in self.folder.glob("w.*"):
            path.unlink()
        kept[0].unlink()
        os.mkfifo(kept[0])
        done = run(self.folder, [*RUN, "--set", "output.file=w.h5", *settle])
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue(stat.S_ISFIFO(kept[0].lstat().st_mode))


if __name__ == "__main__":
    unittest.main()
