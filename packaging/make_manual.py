#!/usr/bin/python3
"""Writes the manual page railwave(1) from what the program says of itself: make_manual.py PROGRAM FILE."""

import re
import sys

from commands import all_commands, read_command, say

EXIT_CODES = (
    ("0", "the run reached its end and no account was broken; the command did what was asked"),
    ("1", "anything else, such as a full disk"),
    ("2", "wrong input: nothing was computed"),
    ("3", "the solution broke down: a fault"),
    ("4", "the wall time was spent; railwave run CASE --restart goes on"),
    ("130", "a signal interrupted it; railwave run CASE --restart goes on"),
)


def escaped(text):
    """Text for troff: a hyphen that may be copied, and no line taken for a request."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", text)


def entry_lines(entry):
    name = re.sub(r"\s+(Excludes|Needs): \S+", "", entry.name.replace(" REQUIRED", ""))
    first, _, rest = re.sub(r"\{.*?\}", "", name).partition(" ")
    rest = rest.replace(" ...", "")
    return [".TP", rf"\fB{escaped(first)}\fR" + (rf" \fI{escaped(rest)}\fR" if rest else ""), escaped(entry.text)]


def command_lines(command):
    usage = " ".join(["railwave", *command.words])
    arguments = " ".join(entry.name.split()[0].upper() for entry in command.positionals)
    lines = [f'.SS "{escaped(usage)}"', escaped(command.about[:1].upper() + command.about[1:]) + "."]
    if arguments:
        lines += [".PP", rf"\fB{escaped(usage)}\fR [\fIoptions\fR] \fI{escaped(arguments)}\fR"]
    for entry in command.positionals + [option for option in command.options if "--help" not in option.flags]:
        lines += entry_lines(entry)
    return lines


def manual(program):
    version = say(program, "--version").split()[-1]
    top = read_command(program)
    name, _, about = top.about.partition(": ")
    lines = [
        f'.TH RAILWAVE 1 "" "railwave {version}" "User commands"',
        ".SH NAME",
        f"railwave \\- {escaped(about)}",
        ".SH SYNOPSIS",
        r"\fBrailwave run\fR \fICASE\fR [\fB\-\-set\fR \fIsection.key=value\fR]",
        ".br",
        r"\fBrailwave\fR \fICOMMAND\fR [\fIoptions\fR] ...",
        ".br",
        r"\fBrailwave help\fR [\fIsection, key or command\fR]",
        ".SH DESCRIPTION",
        f"{name} reads a case file (TOML, SI units), computes the dynamic interaction of wheel and rail with explicit",
        r"finite elements and writes its results to a folder of their own, \fIresults/NAME/\fR.",
        r"Examples are in \fI/usr/share/doc/railwave/examples\fR, pages about all of it in",
        r"\fI/usr/share/doc/railwave\fR.",
        ".SH COMMANDS",
    ]
    for command in all_commands(top):
        if command.words and not command.subcommands:
            lines += command_lines(command)
    lines += [".SH EXIT STATUS"]
    for code, meaning in EXIT_CODES:
        lines += [".TP", rf"\fB{code}\fR", escaped(meaning)]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: make_manual.py PROGRAM FILE")
    page = manual(sys.argv[1])
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(page)
