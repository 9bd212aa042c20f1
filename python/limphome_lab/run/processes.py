"""Child processes that never outlive this one, each with its output in a log file."""

import ctypes
import signal
import subprocess

from limphome_lab.ending import Ending

PR_SET_PDEATHSIG = 1
GRACE_S = 10.0  # to end cleanly after a signal, before the next, harder one
LOG_TAIL = 15  # lines

_libc = ctypes.CDLL(None, use_errno=True)


class Interrupted(Ending):
    """The user, or the system, asked this process to end."""

    def __init__(self, signum):
        super().__init__()  # who asked knows why
        self.exit_code = 128 + signum


def raise_on_signals():
    """Makes SIGINT, SIGTERM and SIGHUP raise Interrupted, once: the clean-up that follows is not interrupted again."""
    signals = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)

    def handler(signum, _frame):
        for each in signals:
            signal.signal(each, signal.SIG_IGN)
        raise Interrupted(signum)

    for each in signals:
        signal.signal(each, handler)


class Child:
    """One of the two programs, running."""

    def __init__(self, name, command, log):
        self.name = name
        self.log = log
        # a session of its own: Ctrl-C in the terminal reaches this process alone, which ends its children in order
        with open(log, "ab") as output:
            self.process = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
                preexec_fn=_prepare,
            )

    def exit_code(self):
        """None while it runs; negative where a signal ended it."""
        return self.process.poll()

    def stop(self, first=signal.SIGTERM):
        """Ends it, cleanly if it will; returns its exit code."""
        for signum in (first, signal.SIGTERM, signal.SIGKILL):
            if self.exit_code() is not None:
                break
            self.process.send_signal(signum)
            try:
                self.process.wait(GRACE_S)
            except subprocess.TimeoutExpired:
                continue
        return self.process.wait()

    def log_tail(self):
        lines = self.log.read_text(errors="replace").splitlines()
        return "\n".join(lines[-LOG_TAIL:])


def _prepare():
    """In the child, before the program: die with the parent, and take no inherited 'ignore' for signals."""
    _libc.prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
    for each in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(each, signal.SIG_DFL)
