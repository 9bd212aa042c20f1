"""An X display that is reached from a run's network too.

A window on a run is opened by a program that has joined the run's network namespace. A display's socket in the file
system is reached from there, but not one in the abstract name space, nor one on the loopback, as `ssh -X` makes it.
Such a display gets a socket of the same address inside, and a process outside that passes on what comes in: neither
DISPLAY nor the authority changes, and nothing else of the outer network is to be had.
"""

import ctypes
import os
import re
import signal
import socket
import subprocess
import sys
import threading

from limphome_lab.runfolder import InputError

SOCKETS = "/tmp/.X11-unix/X"
FIRST_PORT = 6000
PR_SET_PDEATHSIG = 1


def reachable_from(prefix):
    """Sees to it that DISPLAY can be reached by a command that is started with the words `prefix` before it."""
    display = os.environ.get("DISPLAY", "")
    parts = re.fullmatch(r"(localhost|127\.0\.0\.1|unix)?:(\d+)(\.\d+)?", display)
    if not parts:
        raise InputError(f"the display {display} cannot be reached from the run's own network")
    number = int(parts[2])
    if parts[1] in (None, "unix"):
        if _answers(SOCKETS + str(number)):
            return
        address = f"\0{SOCKETS}{number}"
    else:
        address = ("127.0.0.1", FIRST_PORT + number)
    if not _answers(address):
        raise InputError(f"no display answers at {display}")
    _pass_on_while_this_process_lives(_listener_inside(prefix, address), address)


def _connected(address):
    made = socket.socket(socket.AF_INET if isinstance(address, tuple) else socket.AF_UNIX)
    made.connect(address)
    return made


def _answers(address):
    try:
        _connected(address).close()
    except OSError:
        return False
    return True


def _listener_inside(prefix, address):
    """A socket that listens at `address` in the network to which `prefix` leads; made there, and sent here."""
    ours, theirs = socket.socketpair()
    code = f"from limphome_lab.show import display; display.send_listener({theirs.fileno()}, {address!r})"
    made = subprocess.run(
        [*prefix, sys.executable, "-c", code], pass_fds=[theirs.fileno()], capture_output=True, text=True
    )
    if made.returncode != 0:
        raise InputError(f"the display cannot be brought into the run's network:\n{made.stderr}")
    _, (descriptor,), _, _ = socket.recv_fds(ours, 1, 1)
    return socket.socket(fileno=descriptor)


def send_listener(descriptor, address):
    """Inside: makes the socket and sends it through another one."""
    listener = socket.socket(socket.AF_INET if isinstance(address, tuple) else socket.AF_UNIX)
    listener.bind(address)
    listener.listen()
    socket.send_fds(socket.socket(fileno=descriptor), [b"1"], [listener.fileno()])


def _pass_on_while_this_process_lives(listener, address):
    this = os.getpid()
    if os.fork():
        listener.close()
        return
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    while os.getppid() == this:
        inside, _ = listener.accept()
        outside = _connected(address)
        for source, sink in ((inside, outside), (outside, inside)):
            threading.Thread(target=_pump, args=(source, sink), daemon=True).start()
    os._exit(0)


def _pump(source, sink):
    try:
        while data := source.recv(1 << 16):
            sink.sendall(data)
        sink.shutdown(socket.SHUT_WR)
    except OSError:
        pass  # one side has gone
