#!/usr/bin/python3
"""What scripts/hip compiles, and what came of it.

device_code.py objects BUILD               the object files of all sources that include Kokkos, one a line
device_code.py check BUILD ARCHITECTURE    counts the kernels for that architecture (gfx908) that lie in these objects

The check fails where an object is not there or has no code for the architecture, where a source launches kernels and
its object has none of ours, and where a functor of kernels/ or src/ is in no kernel at all. Needs llvm-nm, llvm-objcopy
and clang-offload-bundler of LLVM 15, which Debian's hipcc brings along."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
INCLUDE = re.compile(r'^\s*#\s*include\s+["<]([^">]+)[">]', re.MULTILINE)
LAUNCH = re.compile(r"\bparallel_(for|reduce|scan)\b")
# A functor's begin, or its call operator for the device; with how far it is indented.
FUNCTOR = re.compile(r"^(?P<indent> *)(?:(?:struct|class) (?P<name>\w+)(?:<[^;(){}]*>)?(?: final)?"
                     r"(?:\s*:[^;(){}]*)?\s*\{|KOKKOS_\w*FUNCTION void operator\(\))", re.MULTILINE)
# What has no kernel with HIP: values of recorded steps, which are recorded with CUDA only (src/solve/launch_graph.hpp);
# rows that a host copies and a device does not.
WITHOUT_KERNEL = {"TakeStepValues", "CopyNonzeroRow"}


class Source:
    """A source file, its object, and whether it includes Kokkos directly or by other files of this project."""

    def __init__(self, entry):
        self.path = pathlib.Path(entry["file"]).resolve()
        folder = pathlib.Path(entry["directory"])
        self.object = re.search(r" -o (\S+) -c ", entry["command"])[1]
        self.object_path = folder / self.object

    def name(self):
        return str(self.path.relative_to(ROOT))

    def launches(self):
        return LAUNCH.search(self.path.read_text(encoding="utf-8")) is not None


class Includes:
    """Which files of this project include Kokkos, by whatever way."""

    def __init__(self):
        self.known = {}

    def direct(self, path):
        if path not in self.known:
            names = INCLUDE.findall(path.read_text(encoding="utf-8"))
            found = set()
            for name in names:
                for folder in (path.parent, ROOT, ROOT / "src"):
                    other = pathlib.Path(os.path.normpath(folder / name))
                    if other.is_file():
                        found.add(other)
                        break
            self.known[path] = (found, any(name.startswith("Kokkos_") for name in names))
        return self.known[path]

    def kokkos(self, path):
        seen, open_files = {path}, [path]
        while open_files:
            files, here = self.direct(open_files.pop())
            if here:
                return True
            open_files += files - seen
            seen |= files
        return False


def sources(build):
    """Of the program and its libraries; benchmarks and studies have no kernels of their own."""
    with open(build / "compile_commands.json", encoding="utf-8") as file:
        all_sources = [Source(entry) for entry in json.load(file)]
    includes = Includes()
    ours = [one for one in all_sources if one.object.startswith("src/")]
    return sorted((one for one in ours if includes.kokkos(one.path)), key=Source.name)


def functors():
    """Names of all functors that have a call operator for the device, with the file that each is in; without those that
    are members of another functor or begin within it, which calls them."""
    found, within, texts = {}, {}, {}
    for path in sorted([*(ROOT / "kernels").rglob("*.hpp"), *(ROOT / "src").rglob("*.[ch]pp")]):
        texts[path] = path.read_text(encoding="utf-8")
        around = []  # functors that begin before, with their indents
        for match in FUNCTOR.finditer(texts[path]):
            indent = len(match["indent"])
            around = [(name, of_name) for name, of_name in around if of_name < indent]
            if match["name"]:
                around.append((match["name"], indent))
            elif around:
                found[around[-1][0]] = str(path.relative_to(ROOT))
                within[around[-1][0]] = {name for name, _ in around[:-1]}
    kernels = "".join(text for path, text in texts.items() if path.is_relative_to(ROOT / "kernels"))
    return {name: place for name, place in found.items()
            if not within[name] & found.keys() and not re.search(rf"^ +(?:const )?{name} \w+;$", kernels, re.MULTILINE)}


def call(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def kernels_of(path, architecture, folder):
    """Names of the kernels in an object's code for the architecture, None if it has no such code; and its bytes."""
    bundle, code = folder / "bundle", folder / "code"
    section = subprocess.run(["llvm-objcopy-15", f"--dump-section=.hip_fatbin={bundle}", str(path), os.devnull],
                             check=False, capture_output=True)
    if section.returncode != 0:
        return None, 0
    held = call("clang-offload-bundler-15", "--list", "--type=o", f"--input={bundle}").split()
    target = next((one for one in held if one.endswith("-" + architecture)), None)
    if target is None:
        return None, 0
    call("clang-offload-bundler-15", "--unbundle", "--type=o", f"--targets={target}", f"--input={bundle}",
         f"--output={code}")
    symbols = call("llvm-nm-15", "--format=just-symbols", str(code)).split()
    # Each kernel has a descriptor of its name with ".kd".
    return {name[:-3] for name in symbols if name.endswith(".kd")}, code.stat().st_size


def is_ours(kernel):
    return "8railwave" in kernel  # the namespace as a mangled name has it; others are Kokkos' own, such as fills


def check(build, architecture):
    faults, kernels, bytes_of_code, with_kernels = [], set(), 0, 0
    chosen = sources(build)
    with tempfile.TemporaryDirectory() as folder:
        for source in chosen:
            if not source.object_path.is_file():
                faults.append(f"{source.name()}: not compiled")
                continue
            found, size = kernels_of(source.object_path, architecture, pathlib.Path(folder))
            if found is None:
                faults.append(f"{source.name()}: its object has no code for {architecture}")
                continue
            own = {name for name in found if is_ours(name)}
            if source.launches() and not own:
                faults.append(f"{source.name()}: it launches kernels, and its object has none")
            with_kernels += bool(own)
            kernels |= own
            bytes_of_code += size
    everything = "\n".join(kernels)
    known = functors()
    for name, place in known.items():
        if f"{len(name)}{name}" not in everything and name not in WITHOUT_KERNEL:
            faults.append(f"{place}: functor {name} is in no kernel")
    if not kernels:
        faults.append("no kernel was found")
    for fault in faults:
        print(f"railwave: error: {fault}", file=sys.stderr)
    print(f"{len(chosen)} sources that include Kokkos, {with_kernels} of them with kernels of ours: {len(kernels)}"
          f" kernels of {len(known)} functors for {architecture}, {bytes_of_code / 1e6:.1f} MB of device code")
    return 1 if faults else 0


def main(arguments):
    if len(arguments) == 2 and arguments[0] == "objects":
        print("\n".join(one.object for one in sources(pathlib.Path(arguments[1]))))
        return 0
    if len(arguments) == 3 and arguments[0] == "check":
        return check(pathlib.Path(arguments[1]), arguments[2])
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
