"""What a script says on standard output: it goes on when its reader has gone (`| head`); a full disk it tells at its
end, with status 1."""

import io
import os
import pathlib
import sys


class _Output(io.RawIOBase):
    def __init__(self, descriptor):
        super().__init__()
        self.descriptor, self.nobody_reads, self.failure = descriptor, False, None

    def writable(self):
        return True

    def fileno(self):
        return self.descriptor

    def isatty(self):
        return os.isatty(self.descriptor)

    def write(self, data):
        size = len(data)
        try:
            return size if self.nobody_reads else os.write(self.descriptor, data)
        except BrokenPipeError:
            self.nobody_reads = True
        except OSError as error:
            self.failure = self.failure or error
        return size


def run(main):
    """Does main() and ends the script with what that returns, or exits with."""
    if sys.stdout is None:  # closed by whoever started the script
        sys.exit(main())
    output = _Output(sys.stdout.fileno())
    sys.stdout = io.TextIOWrapper(
        io.BufferedWriter(output), encoding=sys.stdout.encoding, errors=sys.stdout.errors,
        line_buffering=output.isatty(),
    )
    try:
        status = main()
    except SystemExit as end:
        status = end.code
    finally:
        sys.stdout.flush()
    if output.failure:
        print(
            f"{pathlib.Path(sys.argv[0]).name}: not all that was to go to standard output got there:"
            f" {output.failure.strerror}",
            file=sys.stderr,
        )
        status = status or 1
    sys.exit(status)
