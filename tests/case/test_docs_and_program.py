"""What README.md and docs/ say of commands, options and keys is what the program has, and the other way round; the JSON
schema takes every case that the program takes, and refuses the broken ones that a schema can refuse."""

import json
import os
import pathlib
import re
import shlex
import subprocess
import tomllib
import unittest

import extreme_values
import json_schema

SOURCE = pathlib.Path(os.environ.get("RAILWAVE_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
PAGES = [SOURCE / "README.md", *sorted((SOURCE / "docs").glob("*.md"))]
SINGLE = ("settle", "time", "checkpoint", "solver", "monitor", "output", "gravity")


def help_of(*command):
    return subprocess.run(
        [extreme_values.PROGRAM, *command, "--help"], capture_output=True, check=True, text=True
    ).stdout


def commands():
    """'run' -> its options; 'signal psd' too."""
    def names(text):
        return re.findall(r"^  ([a-z]+) ", text.split("Subcommands:")[1], re.M) if "Subcommands:" in text else []

    def options(text):
        return set(re.findall(r"^  (?:-\w,)?(--[a-z][a-z0-9-]*)", text, re.M))

    found = {"": options(help_of())}
    for name in names(help_of()):
        text = help_of(name)
        found[name] = options(text)
        for kind in names(text):
            found[f"{name} {kind}"] = options(help_of(name, kind))
    return found


def code_of(page):
    """Code spans and lines of code blocks; a line that goes on behind a backslash is one."""
    text = page.read_text(encoding="utf-8").replace("\\\n", " ")
    blocks = re.findall(r"```[a-z]*\n(.*?)```", text, re.S)
    lines = [line.strip() for block in blocks for line in block.splitlines()]
    return lines + [
        span.replace("\n", " ") for span in re.findall(r"`([^`]+)`", re.sub(r"```.*?```", "", text, flags=re.S))
    ]


def command_lines():
    for page in PAGES:
        for code in code_of(page):
            if re.match(r"(?:\S*/)?railwave [a-z]", code):
                code = re.split(r" +#| \|", code)[0].replace("...", "")
                yield page.name, code, shlex.split(re.sub(r"[\[\]]", " ", code).replace("'", "'"))[1:]


class Commands(unittest.TestCase):
    known = commands()

    def test_commands_and_options_of_the_docs_exist(self):
        seen = 0
        for page, code, words in command_lines():
            with self.subTest(page=page, code=code):
                command = words[0]
                self.assertIn(command, self.known)
                options = set(self.known[command])
                if len(words) > 1 and f"{command} {words[1]}" in self.known:
                    options = self.known[f"{command} {words[1]}"]
                elif command == "signal":
                    options = set.union(*(has for name, has in self.known.items() if name.startswith("signal")))
                for word in words[1:]:
                    if word.startswith("--"):
                        self.assertIn(word.split("=")[0], options)
                seen += 1
        self.assertGreater(seen, 40)

    def test_every_option_is_documented(self):
        text = "\n".join(page.read_text(encoding="utf-8") for page in PAGES)
        for command, options in self.known.items():
            for option in options - {"--help", "--version"}:
                with self.subTest(command=command, option=option):
                    self.assertRegex(text, re.escape(option) + r"(?![\w-])")

    def test_options_without_a_command_exist_somewhere(self):
        others = "\n".join(
            path.read_text(encoding="utf-8", errors="replace")
            for path in (SOURCE / "scripts").rglob("*")
            if path.is_file()
        )
        others += "\n".join(
            path.read_text(encoding="utf-8")
            for path in [
                *SOURCE.glob("benchmarks/**/*.py"), *SOURCE.glob("benchmarks/**/*.cpp"), *SOURCE.glob("tests/**/*.py"),
            ]
        )
        every = set.union(*self.known.values())
        foreign = {"--version", "--schedule-random", "--output-on-failure"}
        for page in PAGES:
            for code in code_of(page):
                for option in re.findall(r"(?<![\w-])--[a-z][a-z0-9-]+", code):
                    if (
                        re.match(r"(ctest|cmake|apt|git|mpirun|kokkos|nvcc|perf|valgrind)", code)
                        or option in every | foreign
                    ):
                        continue
                    with self.subTest(page=page.name, code=code):
                        self.assertIn(f'"{option}"' if f'"{option}"' in others else option, others)


class Keys(unittest.TestCase):
    schema = extreme_values.schema()

    def keys(self, section):
        found = self.schema["properties"][section]
        if isinstance(found.get("additionalProperties"), dict):
            found = found["additionalProperties"]
        return set().union(*(one["properties"] for one in found.get("oneOf", [found])))

    def test_overrides_in_the_docs_name_keys(self):
        seen = 0
        for page in PAGES:
            for code in code_of(page):
                for place in re.findall(r"--set ['\"]?([a-z_]+(?:\.[\w-]+)+)=", code):
                    if place.startswith("section."):
                        continue
                    with self.subTest(page=page.name, place=place):
                        section, *_, key = place.split(".")
                        self.assertIn(section, self.schema["properties"])
                        self.assertIn(key, self.keys(section))
                        seen += 1
        self.assertGreater(seen, 10)

    def test_keys_named_with_their_section_exist(self):
        for page in PAGES:
            for code in code_of(page):
                for section, key in re.findall(r"(?<![\w./-])([a-z_]+)\.([a-z_]+)(?![\w.(/])", code):
                    if section in SINGLE and key not in ("h5", "xdmf", "toml", "csv", "cpp", "hpp", "md"):
                        with self.subTest(page=page.name, code=code):
                            self.assertIn(key, self.keys(section))

    def test_defaults_of_the_monitor_are_those_of_the_table(self):
        properties, seen = self.schema["properties"]["monitor"]["properties"], 0
        for key, default in re.findall(
            r"\| `([a-z_]+)` \| ([0-9.e-]+)", (SOURCE / "docs/monitor.md").read_text(encoding="utf-8")
        ):
            if key in properties:
                stated = re.search(r"default ([0-9.e+-]+)$", properties[key]["description"])
                self.assertEqual(float(default), float(stated[1]), key)
                seen += 1
        self.assertGreaterEqual(seen, 5)


class Schema(unittest.TestCase):
    schema = extreme_values.schema()
    # Complaints that a schema can make too: kinds of values, ranges, choices, unknown and missing keys.
    words = re.compile(
        r"must be (above|below|at least|at most|between) [-0-9.e+]+( and (below|at most) [-0-9.e+]+)?("
        r" [A-Za-z/0-9]+)?$|unknown (key|section)|"
        r"is missing; must(?!.* unless )|must be (a number|true or false|three numbers|a whole number|text in quotes|')"
    )

    def test_takes_every_case(self):
        cases = [*SOURCE.glob("cases/**/*.toml"), *SOURCE.glob("tests/**/*.toml")]
        cases = [path for path in cases if "bad" not in path.parts and "fuzz" not in path.parts]
        self.assertGreater(len(cases), 15)
        for path in cases:
            with self.subTest(path=path.name):
                self.assertEqual(json_schema.mistakes(tomllib.loads(path.read_text(encoding="utf-8")), self.schema), [])
        for name, text in extreme_values.SCENES.items():
            with self.subTest(scene=name):
                self.assertEqual(json_schema.mistakes(tomllib.loads(text), self.schema), [])

    def test_refuses_what_a_schema_can(self):
        refused = 0
        for path in sorted((SOURCE / "tests/case/bad").glob("*.toml")):
            text = path.read_text(encoding="utf-8")
            expected = re.findall(r"^# expect: .*?: (?:\[[^\]]*\] )?\w+: (.*)$", text, re.M)
            if not any(self.words.search(one) for one in expected):
                continue
            try:
                case = tomllib.loads(text)
            except tomllib.TOMLDecodeError:
                continue
            with self.subTest(path=path.name, expected=expected):
                self.assertNotEqual(json_schema.mistakes(case, self.schema), [])
                refused += 1
        self.assertGreater(refused, 20)


class Limits(unittest.TestCase):
    """Values outside of what the schema states are refused by the program: a scene's numbers all at once, as it tells
    all mistakes."""

    def test_program_refuses_what_the_schema_refuses(self):
        import tempfile
        document = extreme_values.schema()
        with tempfile.TemporaryDirectory() as folder:
            extreme_values.write_scenes(folder)
            tried, seen = set(), 0
            for scene, text in extreme_values.SCENES.items():
                wrong = []
                for section, name, entry in extreme_values.entries(text):
                    for key, about in extreme_values.keys_of(document, section, entry).items():
                        inner = about.get("items", about)
                        high = inner.get("maximum", inner.get("exclusiveMaximum"))
                        if (
                            inner.get("type") not in ("number", "integer")
                            or high is None
                            or (section, entry.get("type"), key) in tried
                        ):
                            continue
                        tried.add((section, entry.get("type"), key))
                        value = (
                            str(int(high) + 1)
                            if inner["type"] == "integer"
                            else repr(float(high) * (1.001 if high > 0 else 0.999) + (high == 0))
                        )
                        value = value if inner is about else "[" + ", ".join([value] * about.get("minItems", 1)) + "]"
                        wrong.append((".".join(part for part in (section, name, key) if part), key, value))
                for first in range(0, len(wrong), 20):
                    some = wrong[first:first + 20]
                    code, _, err = extreme_values.say(folder, scene, *(f"{place}={value}" for place, _, value in some))
                    self.assertEqual(code, 2, err)
                    for place, key, value in some:
                        with self.subTest(scene=scene, place=place, value=value):
                            self.assertRegex(err, rf"{key}: .*must be ")
                            seen += 1
            self.assertGreater(seen, 150)


if __name__ == "__main__":
    unittest.main()
