"""Runs what a study is made of, and goes on where an earlier call ended."""

import csv
import json
import pathlib
import subprocess
import sys
import time

import h5py

PROJECT = pathlib.Path(__file__).resolve().parents[2]


class Failed(Exception):
    """A step did not get through; the text says which, and what to look at."""


def completed(results):
    """Whether a results file is there and its run came to its end."""
    try:
        with h5py.File(results, "r") as file:
            return bool(file.attrs.get("completed", 0))
    except OSError:
        return False


def rows_of(path):
    """Rows of a table as dictionaries of text."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Steps:
    """Steps of a study in one folder. What was done with the same arguments is not done again."""

    def __init__(self, folder, program):
        self.folder, self.program = pathlib.Path(folder).resolve(), str(program)
        self.folder.mkdir(parents=True, exist_ok=True)
        self._list = self.folder / "steps.json"
        self._done = json.loads(self._list.read_text()) if self._list.exists() else {}

    def path(self, name):
        return self.folder / name

    def write_case(self, name, text):
        """A case of this text, not written again where it is the same: what was run with it is there already."""
        path = self.path(f"{name}.toml")
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
        return path

    def command(self, *words, quiet=False):
        """A command whose failure ends the study; `quiet`: without what it prints."""
        words = [str(word) for word in words]
        ended = subprocess.run(words, stdout=subprocess.DEVNULL if quiet else None, check=False)
        if ended.returncode != 0:
            raise Failed(f"{' '.join(words)} ended with code {ended.returncode}")

    def once(self, name, inputs, arguments, work):
        """Does `work` unless it was done with the same arguments after its input files were written."""
        stamp = [str(argument) for argument in arguments] + [self._age(path) for path in inputs]
        if self._done.get(name, {}).get("stamp") == stamp:
            print(f"== {name}: there already", flush=True)
            return
        print(f"== {name}", flush=True)
        began = time.monotonic()
        work()
        self._done[name] = {"stamp": stamp, "seconds": round(time.monotonic() - began, 1)}
        unfinished = self._list.with_suffix(".new")
        unfinished.write_text(json.dumps(self._done, indent=1))
        unfinished.replace(self._list)

    def derive(self, path, results, *words):
        """What a command of the program makes of results: `words`, which end with the option that takes `path`,
        without what it prints. Returns the path."""
        words = [self.program, *words, path, "--overwrite"]
        self.once(path.stem, [results], words, lambda: self.command(*words, quiet=True))
        return path

    def run(self, name, case, overrides):
        """The results file of a run. One that was interrupted goes on from its checkpoint."""
        results = self.path(f"{name}.h5")
        arguments = ["run", case]
        for override in [*overrides, f"output.file={results}"]:
            arguments += ["--set", override]

        def work():
            going_on = results.exists() and self.path(f"{name}.checkpoint.h5").exists()
            more = ["--restart"] if going_on else ["--overwrite"] if results.exists() else []
            self.command(self.program, *arguments, *more)
            if not completed(results):
                raise Failed(f"the run of {results} did not come to its end")

        if not completed(results):
            self._done.pop(name, None)
        self.once(name, [case], arguments, work)
        return results

    def seconds(self, name):
        """How long a step took when it was done, s."""
        return self._done.get(name, {}).get("seconds")

    @staticmethod
    def _age(path):
        return f"{path} {pathlib.Path(path).stat().st_mtime_ns}"


def main(study, work):
    """Calls work() and reports by the name of the study what failed, without a traceback."""
    try:
        work()
    except Failed as failure:
        sys.exit(f"{study}: error: {failure}")
    except KeyboardInterrupt:
        sys.exit(f"{study}: interrupted; the same command goes on from here")
