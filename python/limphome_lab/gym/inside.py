"""python inside.py DESCRIPTOR PARENT PROGRAM...: what is run in a plant's network, before the plant.

Hands two datagram sockets of this network through DESCRIPTOR to the process PARENT, which is outside, and becomes
PROGRAM, which ends when PARENT does. It uses nothing but the standard library, so that it starts soon.
"""

import ctypes
import os
import signal
import socket
import sys

PR_SET_PDEATHSIG = 1


def main(descriptor: int, parent: int, program: list[str]) -> None:
    # anew, as a change of user namespace forgets it
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:
        return
    with socket.socket(fileno=descriptor) as outside:
        pair = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2)]
        socket.send_fds(outside, [b"!"], [each.fileno() for each in pair])
    for each in pair:
        each.close()
    os.execv(program[0], program)


main(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3:])
