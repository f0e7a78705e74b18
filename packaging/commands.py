"""What `railwave` says of its own commands: a tree of them, read from their --help."""

import dataclasses
import re
import subprocess

HEADINGS = ("Positionals", "Options", "Subcommands")


@dataclasses.dataclass
class Entry:
    """A line of a help text: `name` as it stands there, such as "--set TEXT ...", and what it says of it."""

    name: str
    text: str = ""

    @property
    def flags(self):
        """Such as ["-h", "--help"]; empty for a positional argument."""
        first = self.name.split()[0].partition("{")[0]  # "--no-pictures{false}"
        return first.split(",") if first.startswith("-") else []

    @property
    def takes_value(self):
        return bool(re.search(r"\b(TEXT|FLOAT|INT|UINT)\b", self.name))


@dataclasses.dataclass
class Command:
    words: tuple  # ("signal", "psd"); () for the program itself
    about: str
    positionals: list
    options: list
    subcommands: list


def say(program, *arguments):
    """Standard output of the program; raises CalledProcessError where it fails."""
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=True).stdout


def entries_of(lines):
    entries = []
    for line in lines:
        if re.match(r"  \S", line):
            name, _, text = line.strip().partition("  ")
            entries.append(Entry(name, text.strip()))
        elif line.strip():
            entries[-1].text = (entries[-1].text + " " + line.strip()).strip()
    return entries


def read_command(program, words=()):
    """The command of these words with all below it. ValueError for a help text in another layout than that of CLI11."""
    about, *lines = say(program, *words, "--help").splitlines()
    sections, heading = {}, None
    for line in lines:
        if line.rstrip(":") in HEADINGS:
            heading = line.rstrip(":")
        elif heading and not line.startswith("Usage:"):
            sections.setdefault(heading, []).append(line)
    found = {name: entries_of(sections.get(name, [])) for name in HEADINGS}
    if not found["Options"]:
        raise ValueError(f"railwave {' '.join(words)} --help lists no options")
    below = [read_command(program, (*words, entry.name)) for entry in found["Subcommands"]]
    return Command(words, about, found["Positionals"], found["Options"], below)


def all_commands(command):
    """The command and those below it, in the order of the help text."""
    yield command
    for below in command.subcommands:
        yield from all_commands(below)
