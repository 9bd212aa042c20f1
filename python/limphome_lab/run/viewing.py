"""--view: the page of scripts/view beside a run, by a process of its own.

It starts before the run enters its network, where no browser could reach it, and finds the run by its process id.
"""

import contextlib
import ctypes
import os
import select
import signal
import subprocess
import sys

PR_SET_PDEATHSIG = 1
ENVIRONMENT = "LIMPHOME_VIEW"  # "pid descriptor", while this process becomes its copy inside the network
JOINED = b"joined\n"  # what the page's process writes once it listens to the run
READY_WITHIN_S = 30.0  # else the run begins without it

_libc = ctypes.CDLL(None)


def add_argument(parser):
    parser.add_argument("--view", action="store_true", help="show the robot in the browser, at a pace to watch it by")


class Viewing:
    """Use as a context round all of the run, network.enter included; leaving it closes the page."""

    def __init__(self, wanted):
        self.pid = self._joined = None
        inherited = os.environ.pop(ENVIRONMENT, None)
        if inherited is not None:
            self.pid, self._joined = map(int, inherited.split())
        elif wanted:
            self.pid, self._joined = _start()
            os.environ[ENVIRONMENT] = f"{self.pid} {self._joined}"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.pid is not None:
            with contextlib.suppress(ProcessLookupError):
                os.kill(self.pid, signal.SIGTERM)
            self._end()

    def wait(self):
        """Until the page listens: it is to show the run from its start."""
        if self._joined is not None:
            if select.select([self._joined], [], [], READY_WITHIN_S)[0]:
                os.read(self._joined, len(JOINED))
            os.set_inheritable(self._joined, False)

    def linger(self):
        """The run has ended well: leaves its last picture there for as long as somebody looks at it."""
        if self.pid is not None:
            print("the page stays while it is open; Ctrl-C closes it", file=sys.stderr)
            self._end()

    def _end(self):
        with contextlib.suppress(ChildProcessError):
            os.waitpid(self.pid, 0)
        self.pid = None


def _start():
    """(process id, descriptor on which it tells that it listens to the run)"""
    joined, joins = os.pipe()
    words = [sys.executable, "-m", "limphome_lab.view.view", "--pid", str(os.getpid()), "--joins", str(joins)]
    # what it says is for a person, and a session of its own keeps Ctrl-C to this process, which then ends it
    process = subprocess.Popen(
        words,
        stdin=subprocess.DEVNULL,
        stdout=sys.stderr,
        start_new_session=True,
        preexec_fn=_die_with_parent,
        pass_fds=[joins],
    )
    os.close(joins)
    os.set_inheritable(joined, True)
    return process.pid, joined


def _die_with_parent():
    _libc.prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
