"""Reading in a process of its own: HDF5 may crash, or go round in circles, in a damaged file."""

import os
import pathlib
import re
import resource
import signal
import sys
import traceback

CRASHES = (signal.SIGSEGV, signal.SIGBUS, signal.SIGABRT, signal.SIGFPE, signal.SIGILL)
BEST_COMPRESSION = 1100  # of zlib: what claims to hold more than its file can is damaged


def look_through(path):
    """Reads a file's structure, its texts and what of its arrays is short. Throws what h5py throws, ValueError where
    they claim too much."""
    import h5py

    size = os.path.getsize(path)

    def look(name, item):
        for value in item.attrs.values():
            str(value)
        if not isinstance(item, h5py.Dataset):
            return
        if item.size * item.dtype.itemsize > max(1 << 20, BEST_COMPRESSION * size):
            raise ValueError(f"{name} claims {item.size} values, more than the file can hold")
        if item.size * item.dtype.itemsize < 1 << 24:
            item[()]
        elif item.ndim:
            item[0], item[-1]

    with h5py.File(path, "r") as file:
        look("/", file)
        file.visititems(look)


def child(path, work):
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    signal.signal(signal.SIGPROF, signal.SIG_DFL)
    try:
        signal.setitimer(signal.ITIMER_PROF, 5 + os.path.getsize(path) / 5e6)
        look_through(path)
    except OSError as error:
        if re.search("nable to (synchronously )?open file", str(error)) or not os.path.isfile(path):
            signal.setitimer(signal.ITIMER_PROF, 0)
            return work()  # which tells better what is wrong
        print(f"{path} is damaged: {error}; copy it again, or repeat the run", file=sys.stderr)
        return 2
    except Exception as error:  # whatever h5py makes of it
        print(f"{path} is damaged: {type(error).__name__}: {error}; copy it again, or repeat the run", file=sys.stderr)
        return 2
    signal.setitimer(signal.ITIMER_PROF, 0)
    try:
        return work()
    except Exception as error:  # from whatever library a number that makes no sense came to
        frame = traceback.extract_tb(error.__traceback__)[-1]
        print(
            f"{path} is damaged, or of another version: {type(error).__name__}:"
            f" {error} ({pathlib.Path(frame.filename).name}, line {frame.lineno})",
            file=sys.stderr,
        )
        return 2


def in_reading_child(path, work):
    """Runs work(), which reads the file and returns an exit code, in a child process. Returns that code; 2 where a
    signal ended it, and says so."""
    sys.stdout.flush()
    sys.stderr.flush()
    number = os.fork()
    if number == 0:
        code = 1
        try:
            code = child(path, work)
        except SystemExit as end:
            code = end.code if isinstance(end.code, int) else 1
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)
    while True:
        try:
            _, status = os.waitpid(number, 0)
            break
        except KeyboardInterrupt:
            continue  # the child has got it too
    code = os.waitstatus_to_exitcode(status)
    if code >= 0:
        return code
    if -code in CRASHES:
        print(
            f"{path} is damaged: the HDF5 library crashed ({signal.Signals(-code).name}) when it was read; copy it"
            " again, or repeat the run",
            file=sys.stderr,
        )
        return 2
    if -code == signal.SIGPROF:
        print(f"{path} is damaged: reading it came to no end; copy it again, or repeat the run", file=sys.stderr)
        return 2
    return 128 - code
