"""--view: the page of scripts/view beside a run, by a process of its own.

It starts before the run enters its network, where no browser could reach it, and finds the run by its process id.
"""

import contextlib
import ctypes
import os
import signal
import subprocess
import sys

PR_SET_PDEATHSIG = 1
ENVIRONMENT = "LIMPHOME_VIEW"  # process id of the page's, while this process becomes its copy inside the network

_libc = ctypes.CDLL(None)


def add_argument(parser):
    parser.add_argument("--view", action="store_true", help="show the robot in the browser, at a pace to watch it by")


class Viewing:
    """Use as a context round all of the run, network.enter included; leaving it closes the page."""

    def __init__(self, wanted):
        self.pid = None
        inherited = os.environ.pop(ENVIRONMENT, None)
        if inherited is not None:
            self.pid = int(inherited)
        elif wanted:
            self.pid = _start()
            os.environ[ENVIRONMENT] = str(self.pid)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.pid is not None:
            with contextlib.suppress(ProcessLookupError):
                os.kill(self.pid, signal.SIGTERM)
            self._wait()

    def linger(self):
        """The run has ended well: leaves its last picture there for as long as somebody looks at it."""
        if self.pid is not None:
            print("the page stays while it is open; Ctrl-C closes it", file=sys.stderr)
            self._wait()

    def _wait(self):
        with contextlib.suppress(ChildProcessError):
            os.waitpid(self.pid, 0)
        self.pid = None


def _start():
    words = [sys.executable, "-m", "limphome_lab.view.view", "--pid", str(os.getpid())]
    # what it says is for a person, and a session of its own keeps Ctrl-C to this process, which then ends it
    return subprocess.Popen(
        words, stdin=subprocess.DEVNULL, stdout=sys.stderr, start_new_session=True, preexec_fn=_die_with_parent
    ).pid


def _die_with_parent():
    _libc.prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
