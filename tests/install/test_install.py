"""What is installed works without the source tree: a package is made and unpacked, its example is run, and a program
in C++ and one in Python are built on its library."""

import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

BUILD = pathlib.Path(os.environ["RAILWAVE_BIN_DIR"]).parent
SOURCE = os.environ["RAILWAVE_SOURCE_DIR"]
MASS, STIFFNESS, STRETCH = 7.8, 1e8, 1e-5  # kg, N/m, m: of examples/driven_block

PYTHON_RUN = """
import sys, railwave
block = railwave.Simulation(sys.argv[1], 1e-5)
def force():
    return -1e8 * (1e-5 + block.values("set.block.z_max.displacement")[2])
more = True
while more:
    begin = block.save()
    block.drive("pull", force())
    block.advance()
    likely = force()
    block.restore(begin)
    block.drive("pull", likely)
    more = block.advance()
    print("%.9g,%.9g" % (block.time, block.values("set.block.z_max.displacement")[2]))
"""


def run(*command, cwd=None, env=None):
    """Standard output; what was said and an assertion where it fails."""
    words = [str(word) for word in command]
    done = subprocess.run(words, capture_output=True, text=True, cwd=cwd, env=env, check=False)
    assert done.returncode == 0, f"{command}: {done.returncode}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def files_below(folder):
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


def unpacked(scratch):
    """The prefix of a package that was made of the build and unpacked; without Debian's tools, of an installation."""
    root = scratch / "root"
    if shutil.which("dpkg-shlibdeps"):
        run("cpack", "-G", "DEB", "--config", BUILD / "CPackConfig.cmake", "-B", scratch / "made", cwd=BUILD)
        (package,) = (scratch / "made").glob("railwave_*.deb")
        run("dpkg-deb", "-x", package, root)
        check_control(run("dpkg-deb", "-f", package))
    else:
        run("cmake", "--install", BUILD, "--prefix", root / "usr")
    return root / "usr"


def check_control(control):
    depends = re.search(r"^Depends: (.*)$", control, re.M).group(1)
    for library in ("libhdf5", "libfmt", "libgomp1", "libstdc++6"):
        assert library in depends, (library, depends)
    version = re.search(r"^Version: (\S+)$", control, re.M).group(1)
    assert run(BUILD / "bin" / "railwave", "--version").split()[-1] == version


def check_places(prefix):
    files = files_below(prefix)
    for wanted in (
        r"bin/railwave",
        r"lib/(\S+/)?librailwave\.so",
        r"include/railwave/simulation\.hpp",
        r"lib/(\S+/)?cmake/Railwave/RailwaveConfig\.cmake",
        r"share/railwave/scripts/pictures/patch\.py",
        r"share/doc/railwave/copyright",
        r"share/doc/railwave/examples/cases/first_steps\.toml",
        r"share/doc/railwave/examples/library/driven_block\.cpp",
        r"share/bash-completion/completions/railwave",
        r"share/man/man1/railwave\.1",
    ):
        assert any(re.fullmatch(wanted, name) for name in files), (wanted, sorted(files))
    assert not [name for name in files if "__pycache__" in name]


def check_names(prefix):
    """The library shows its classes and nothing of Kokkos; a package's files do not name the source tree."""
    (library,) = [path for path in prefix.rglob("librailwave.so.*.*.*")]
    names = run("nm", "-D", "-C", "--defined-only", library).splitlines()
    strangers = [name for name in names if "railwave::Simulation" not in name and "railwave::InputError" not in name]
    assert names and not strangers, strangers[:5]
    if "RAILWAVE_SOURCE_PLACES:BOOL=OFF" in (BUILD / "CMakeCache.txt").read_text():
        for path in prefix.rglob("*"):
            assert not path.is_file() or SOURCE.encode() not in path.read_bytes(), path


def check_program(prefix, scratch):
    """The packaged example, shortened, in a folder of its own: all it writes is in results/."""
    folder, home = scratch / "work", scratch / "home"
    folder.mkdir()
    home.mkdir()
    shutil.copy(prefix / "share/doc/railwave/examples/cases/first_steps.toml", folder)
    before = files_below(scratch)
    env = {"PATH": "/usr/bin:/bin", "HOME": str(home), "OMP_NUM_THREADS": "1", "OMP_PROC_BIND": "false"}
    run(prefix / "bin" / "railwave", "run", "first_steps.toml", "--set", "time.end=2e-5", cwd=folder, env=env)
    new = files_below(scratch) - before
    assert "work/results/first_steps/first_steps.h5" in new, new
    assert not [name for name in new if not name.startswith("work/results/")], new


def check_pictures(prefix, scratch):
    """railwave-picture finds its modules and the program that it was installed with."""
    help_text = run(prefix / "bin" / "railwave-picture", "--help")
    assert "--sweep" in help_text
    code = "import pathlib, sys; sys.path.insert(0, sys.argv[1]); from pictures.options import program_of\n"
    code += "print(program_of(pathlib.Path(sys.argv[1]).parent))"
    found = run("/usr/bin/python3", "-B", "-c", code, prefix / "share/railwave/scripts")
    assert found.strip() == str(prefix / "bin" / "railwave"), found


def check_library(prefix, scratch):
    """A program against find_package(Railwave), and the same in Python, digit by digit."""
    example = prefix / "share/doc/railwave/examples/library"
    build = scratch / "example"
    run("cmake", "-S", example, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Release")
    run("cmake", "--build", build)
    lines = run(build / "driven_block", example / "driven_block.toml", cwd=scratch).splitlines()
    assert lines[0] == "time_s,displacement_m,velocity_m_per_s,force_N"
    time, moved = (float(word) for word in lines[-1].split(",")[:2])
    # A mass on a spring. The block is softer than a rigid one by its own length: 0.1 m / (E A), 0.5 % of the spring's.
    exact = STRETCH * (math.cos(math.sqrt(STIFFNESS / MASS) * time) - 1)
    assert time > 0.99e-3 and abs(moved - exact) < 0.02 * STRETCH, (time, moved, exact)

    for module in prefix.rglob("railwave.cpython-*.so"):
        env = {**os.environ, "PYTHONPATH": str(module.parent)}
        said = run("/usr/bin/python3", "-B", "-c", PYTHON_RUN, example / "driven_block.toml", env=env).split()
        assert said == [",".join(line.split(",")[:2]) for line in lines[1:]]


def check_completion(prefix, scratch):
    script = prefix / "share/bash-completion/completions/railwave"
    case = prefix / "share/doc/railwave/examples/cases/first_steps.toml"
    program = f"""source {script}; compopt() {{ :; }}
        try() {{ COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _railwave; echo "${{COMPREPLY[*]}}"; }}
        try railwave sig; try railwave signal ps
        try railwave run {case} --set contacts.tread.fric; try railwave run --wall"""
    said = run("bash", "-c", program, cwd=scratch).splitlines()
    assert said[:2] == ["signal", "psd"] and said[3] == "--wall-time", said
    assert "contacts.tread.friction=" in said[2].split(), said
    manual = (prefix / "share/man/man1/railwave.1").read_text()
    for command in run(prefix / "bin" / "railwave", "--help").partition("Subcommands:")[2].split("\n  ")[1:]:
        assert f'.SS "railwave {command.split()[0]}' in manual, command


def main():
    if not (BUILD / "lib" / "librailwave.so").exists():
        print("skipped: this build has no target `installed` (sanitizers, CUDA)")
        return 77
    with tempfile.TemporaryDirectory(prefix="railwave-install-") as folder:
        scratch = pathlib.Path(folder).resolve()
        prefix = unpacked(scratch)
        check_places(prefix)
        check_names(prefix)
        check_program(prefix, scratch)
        check_pictures(prefix, scratch)
        check_completion(prefix, scratch)
        check_library(prefix, scratch)
    print("what is installed works")
    return 0


if __name__ == "__main__":
    sys.exit(main())
