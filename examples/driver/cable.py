"""A serial line between two programs on this machine, where there is no adapter to plug in: cable.py END OTHER

Makes two pseudo terminals and the links END and OTHER to them; what is written to one is read from the other. Ends by
SIGTERM or Ctrl-C and takes the links away.
"""

import contextlib
import os
import pty
import select
import signal
import sys
import tty


def end_of_cable(link):
    """(our side, the side that a program opens, which stays open so that nobody is hung up on)"""
    ours, theirs = pty.openpty()
    tty.setraw(theirs)
    os.set_blocking(ours, False)
    os.symlink(os.ttyname(theirs), link)
    return ours, theirs


def main():
    links = sys.argv[1:3]
    (a, _), (b, _) = map(end_of_cable, links)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        while True:
            for side in select.select([a, b], [], [])[0]:
                data = os.read(side, 4096)
                with contextlib.suppress(BlockingIOError):  # nobody reads there: it is lost
                    os.write(b if side == a else a, data)
    except KeyboardInterrupt:
        for link in links:
            os.unlink(link)


if __name__ == "__main__":
    main()
