"""What a command did with a damaged file, and whether that is as it should be."""

import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess

import h5py

HEAP = b"GCOL"  # HDF5's global heap, which holds the texts, has no checksum


class Outcome:
    def __init__(self, kind, text="", finding=False):
        self.kind, self.text, self.finding = kind, text, finding


class Answer:
    """What a command printed and wrote, how it ended and what it took."""

    def __init__(self, code, said, complaint, files, memory):
        self.code, self.said, self.complaint, self.files, self.memory = code, said, complaint, files, memory

    def same(self, other):
        return self.said == other.said and self.files == other.files


def arrays_of(path):
    """All arrays of an HDF5 file by their names, which its bytes are not: they hold the time."""
    arrays = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, one: arrays.update({name: one[()].tobytes()} if hasattr(one, "dtype") else {}))
    return arrays


def limits():
    os.setsid()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


class Commands:
    """Runs commands on files in a folder of their own."""

    def __init__(self, program, folder, most_seconds=300, most_memory=2e9):
        self.program, self.folder, self.most_seconds, self.most_memory = (
            str(program),
            pathlib.Path(folder),
            most_seconds,
            most_memory,
        )
        self.sanitized = b"__asan_init" in pathlib.Path(program).read_bytes()
        self.sound = {}

    def run(self, seed, words, data):
        shutil.rmtree(self.folder, ignore_errors=True)
        (self.folder / "out").mkdir(parents=True)
        file = seed.path.name if seed.beside else "damaged.h5"
        (self.folder / file).write_bytes(data)
        for other in seed.beside:
            shutil.copy(other, self.folder)
        command = [self.program, *(word.replace("FILE", file).replace("OUT", "out") for word in words.split())]
        environment = dict(
            os.environ,
            OMP_NUM_THREADS="1",
            ASAN_OPTIONS="abort_on_error=1:allocator_may_return_null=1:detect_stack_use_after_return=0",
            UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1:abort_on_error=1",
        )
        with open(self.folder / "said", "wb") as said, open(self.folder / "complaint", "wb") as complaint:
            process = subprocess.Popen(
                command, cwd=self.folder, env=environment, stdout=said, stderr=complaint, preexec_fn=limits
            )
            signal.signal(signal.SIGALRM, lambda *_: os.killpg(process.pid, signal.SIGKILL))
            signal.alarm(self.most_seconds)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = 0  # waited for here
            late = signal.alarm(0) == 0
        files = {path.name: path.read_bytes() for path in sorted((self.folder / "out").iterdir())}
        text = [(self.folder / name).read_text(errors="replace") for name in ("said", "complaint")]
        return Answer("hang" if late else os.waitstatus_to_exitcode(status), *text, files, 1024 * usage.ru_maxrss)

    def numbers_of_restart(self, seed):
        """What the results hold after they were gone on with, as another command tells it; nothing where it refuses."""
        done = subprocess.run(
            [self.program, "contact", "results.h5", "--csv", "out/t.csv"],
            cwd=self.folder, capture_output=True, text=True, check=False,
        )
        return (done.stdout if done.returncode == 0 else ""), done

    def answer(self, seed, name, data):
        answer = self.run(seed, seed.commands[name], data)
        if seed.beside and answer.code == 0:
            answer.said, done = self.numbers_of_restart(seed)
            if done.returncode < 0:
                answer.code = done.returncode
        else:
            # HDF5 notes no times, but the name of the file that was read.
            answer.files = {
                name: arrays_of(self.folder / "out" / name) if name.endswith(".vtkhdf") and answer.code == 0 else data
                for name, data in answer.files.items()
                if not name.endswith(".h5") or answer.code != 0
            }
        return answer

    def sound_answer(self, seed, name):
        key = (seed.name, name)
        if key not in self.sound:
            self.sound[key] = self.answer(seed, name, seed.bytes)
            if self.sound[key].code != 0:
                raise SystemExit(f"{name} refuses the sound file of {seed.name}: {self.sound[key].complaint}")
        return self.sound[key]

    def judge(self, seed, name, data):
        sound, answer = self.sound_answer(seed, name), self.answer(seed, name, data)
        finding = lambda kind: Outcome(kind, answer.complaint[-3000:], True)  # noqa: E731
        if answer.code == "hang":
            return finding("hangs")
        if answer.code < 0:
            return finding(f"signal {-answer.code}")
        if answer.memory > self.most_memory:
            return finding(f"takes {answer.memory / 1e9:.1f} GB")
        if self.sanitized:
            own = re.search(r"ERROR: (Address|Leak)Sanitizer|runtime error:", answer.complaint)
            reported_crash = (
                "HDF5 library crashed" in answer.complaint
                and "in railwave::" not in answer.complaint.split("ERROR:")[-1].split("#6")[0]
            )
            if own and not reported_crash:
                return finding("sanitizer")
        if "HDF5-DIAG" in answer.complaint or "terminate called" in answer.complaint:
            return finding("noise")
        if answer.code == 0:
            if answer.same(sound):
                return Outcome("as from the sound file")
            if seed.beside and not answer.said:
                return Outcome("reported by the next command that reads")
            if not seed.checked:
                return Outcome("other output, file without checksums")
            if self.only_texts(seed, name, data, sound):
                return Outcome("other text")
            return finding("other output without a word")
        if answer.code not in (1, 2):
            return finding(f"exit code {answer.code}")
        if answer.files or list(self.folder.rglob("*.new*")):
            return finding("leaves files")
        if not re.search(r"damaged\.h5|results\.h5|results\.checkpoint\.h5", answer.complaint):
            return finding("message without the file's name")
        if "HDF5 library crashed" in answer.complaint:
            return Outcome("crash of HDF5, reported")
        if "came to no end" in answer.complaint:
            return Outcome("endless loop in HDF5, reported")
        return Outcome("refused with a message")

    def only_texts(self, seed, name, data, sound):
        """Whether the output is the sound one once the texts are mended."""
        mended = bytearray(data)
        for match in re.finditer(HEAP, seed.bytes):
            size = int.from_bytes(seed.bytes[match.start() + 8 : match.start() + 16], "little")
            if size < 1 << 20 and match.start() + size <= len(data):
                mended[match.start() : match.start() + size] = seed.bytes[match.start() : match.start() + size]
        return mended != data and self.answer(seed, name, bytes(mended)).same(sound)
