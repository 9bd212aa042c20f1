"""How a command ends where it cannot do what it was asked to."""

import errno
import functools
import io
import os
import signal
import sys


class Ending(Exception):
    """Ends the command; its text, where there is one, tells the user why."""

    exit_code = 1


class InputError(Ending):
    """Something the user gave is wrong; nothing has been started."""

    exit_code = 2


class Lenient(io.TextIOBase):
    """A stream to tell a person by: where nobody reads it any more, or it was closed, what is told is dropped."""

    def __init__(self, stream):
        self._stream = stream

    def write(self, text):
        self._try(lambda: self._stream.write(text))
        return len(text)

    def flush(self):
        self._try(lambda: self._stream.flush())

    def isatty(self):
        return self._stream is not None and self._stream.isatty()

    def fileno(self):
        if self._stream is None:
            raise io.UnsupportedOperation("fileno")
        return self._stream.fileno()

    def _try(self, action):
        try:
            if self._stream is not None:
                action()
        except (OSError, ValueError):
            self._stream = None


def with_exit_code(main):
    """Decorates a `main` that returns an exit code: it then also returns that of an Ending, having told its text, and
    that of a fault of the system, having told which file it met."""

    @functools.wraps(main)
    def main_with_exit_code():
        try:
            # where the script has held Ctrl-C back while Python began and loaded
            signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
            _prepare_streams()
            code = main()
            sys.stdout.flush()
            return code
        except Ending as ending:
            if str(ending):
                print(ending, file=sys.stderr)
            return ending.exit_code
        except KeyboardInterrupt:
            return 130
        except BrokenPipeError:
            _drop_output()
            return 1
        except OSError as error:
            _drop_output()
            print(told(error), file=sys.stderr)
            return 1

    return main_with_exit_code


def told(error):
    """A fault of the system in a line."""
    where = f"{error.filename}: " if error.filename is not None else ""
    hint = "; make room and go on with it by --resume" if error.errno in (errno.ENOSPC, errno.EDQUOT) else ""
    return f"{where}{error.strerror or error}{hint}"


def _prepare_streams():
    """Any text can be printed, file names that are no UTF-8 among it; no file gets the number of a closed stream."""
    while (descriptor := os.open(os.devnull, os.O_RDWR)) <= 2:
        os.set_inheritable(descriptor, True)
    os.close(descriptor)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    sys.stdout = sys.stdout or open(os.devnull, "w")  # noqa: SIM115
    sys.stderr = sys.stderr if isinstance(sys.stderr, Lenient) else Lenient(sys.stderr)


def _drop_output():
    """What could not be printed is not tried again at the end of the process."""
    with open(os.devnull, "w") as nowhere:
        os.dup2(nowhere.fileno(), 1)
