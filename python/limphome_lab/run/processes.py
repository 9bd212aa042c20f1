"""Child processes that never outlive this one, each with its output in a log file."""

import contextlib
import ctypes
import functools
import os
import signal
import subprocess
import weakref

from limphome_lab.ending import Ending

PR_SET_PDEATHSIG = 1
ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
GRACE_S = 10.0  # to end cleanly after a signal, before the next, harder one
LOG_TAIL = 15  # lines
TAIL_LENGTH = 8192  # [bytes] of a program's last words that are kept

_libc = ctypes.CDLL(None, use_errno=True)
_children = weakref.WeakSet()


class Interrupted(Ending):
    """The user, or the system, asked this process to end."""

    def __init__(self, signum):
        super().__init__()  # who asked knows why
        self.exit_code = 128 + signum


def raise_on_signals():
    """Makes SIGINT, SIGTERM and SIGHUP raise Interrupted, once: the clean-up that follows is not interrupted again.
    SIGHUP stays ignored where it was from the start (nohup). Ctrl-Z stops the children too, until fg."""
    signals = [signal.SIGINT, signal.SIGTERM]
    if signal.getsignal(signal.SIGHUP) != signal.SIG_IGN:
        signals.append(signal.SIGHUP)

    def handler(signum, _frame):
        for each in signals:
            signal.signal(each, signal.SIG_IGN)
        raise Interrupted(signum)

    for each in signals:
        signal.signal(each, handler)
    signal.signal(signal.SIGTSTP, _pause)


def _pause(_signum, _frame):
    """Stops the children and then this process, which stands here until it is let go on."""
    _signal_all(signal.SIGSTOP)
    os.kill(os.getpid(), signal.SIGSTOP)
    _signal_all(signal.SIGCONT)


def _signal_all(signum):
    for child in _children:
        child.process.send_signal(signum)  # nothing where it has ended


class Child:
    """A program, running; what it prints goes to the file `log`. It inherits the descriptors `pass_fds`."""

    def __init__(self, name, command, log, pass_fds=()):
        self.name = name
        self.log = log
        with open(log, "ab") as output:
            self._start(command, output, pass_fds)

    def _start(self, command, output, pass_fds=()):
        # a session of its own: Ctrl-C in the terminal reaches this process alone, which ends its children in order.
        # Until the child has become the program it takes no signal, as it would tell of it in this one's name
        mask = signal.pthread_sigmask(signal.SIG_BLOCK, ENDING)
        try:
            self.process = subprocess.Popen(
                command,
                bufsize=0,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
                preexec_fn=functools.partial(_prepare, mask),
                pass_fds=pass_fds,
            )
            _children.add(self)
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, mask)

    def exit_code(self):
        """None while it runs; negative where a signal ended it."""
        return self.process.poll()

    def stop(self, first=signal.SIGTERM):
        """Ends it, cleanly if it will; returns its exit code."""
        for signum in (first, signal.SIGTERM, signal.SIGKILL):
            if self.exit_code() is not None:
                break
            self.process.send_signal(signum)
            self.process.send_signal(signal.SIGCONT)  # one that is stopped would not take notice
            try:
                self.process.wait(GRACE_S)
            except subprocess.TimeoutExpired:
                continue
        return self.process.wait()

    def log_tail(self):
        return _last_lines(self.log.read_text(errors="replace"))


class ToldChild(Child):
    """A program whose last words are known even where the disk is too full for its log. Look at it often."""

    def __init__(self, name, command, log):
        self.name = name
        self.log = log
        self._tail = b""
        self._start(command, subprocess.PIPE)
        os.set_blocking(self.process.stdout.fileno(), False)

    def exit_code(self):
        code = super().exit_code()
        while told := self.process.stdout.read(TAIL_LENGTH):
            self._tail = (self._tail + told)[-TAIL_LENGTH:]
            with contextlib.suppress(OSError), open(self.log, "ab") as log:
                log.write(told)
        return code

    def stop(self, first=signal.SIGTERM):
        super().stop(first)
        return self.exit_code()

    def log_tail(self):
        return _last_lines(self._tail.decode(errors="replace"))


def _last_lines(text):
    return "\n".join(text.splitlines()[-LOG_TAIL:])


def _prepare(mask):
    """In the child, before the program: die with the parent, and take no inherited 'ignore' for signals, of which none
    but those of `mask` is held back any more. SIGKILL, as one that is stopped heeds no other; the run folder stays
    whole under it."""
    _libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    for each in ENDING:
        signal.signal(each, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_SETMASK, mask)
