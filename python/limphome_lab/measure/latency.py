"""How long the controller takes from a state to its command, heard from outside by the kernel's clock."""

import socket
import struct

from limphome_lab import network
from limphome_lab.channels import COMMAND, STATE

SO_TIMESTAMPNS = 35  # Linux; Python has no name for it
RECEIVE_BUFFER = 64 << 20  # [bytes]; the kernel grants up to net.core.rmem_max
LARGEST = 65507  # bytes of a datagram
MOST_WAITING = 1000  # states without an answer that are remembered

BEGINNING = struct.Struct(">8xqqq")  # of both messages: fingerprint, utime, session, seq
HEADER = 8  # bytes of LCM's before the channel's name
STATE_NAME = STATE.encode() + b"\0"
COMMAND_NAME = COMMAND.encode() + b"\0"


class Latencies:
    """Listens on the bus of `port`; `take` must be called often enough for the socket's buffer not to overflow.

    Both times are the kernel's, of when a datagram came to this socket, so it does not matter when it is read. What is
    measured is what the plant sees but for its own waking: the controller's waking, decision and sending."""

    def __init__(self, port=network.PORT):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, RECEIVE_BUFFER)
        self.socket.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
        self.socket.bind((network.GROUP, port))
        membership = socket.inet_aton(network.GROUP) + socket.inet_aton("0.0.0.0")
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)
        self.socket.setblocking(False)
        self.answered = 0  # states, each once
        self._waiting = {}  # (session, seq) -> when it came [s]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def take(self):
        """Latencies [s] of the states answered since the last call."""
        latencies = []
        while True:
            try:
                data, ancillary, _, _ = self.socket.recvmsg(LARGEST, 64)
            except BlockingIOError:
                self.answered += len(latencies)
                return latencies
            if data.startswith(STATE_NAME, HEADER):
                key = self._key(data, STATE_NAME)
                self._waiting.setdefault(key, _came(ancillary))  # a state that comes again is waited upon longer
                if len(self._waiting) > MOST_WAITING:
                    del self._waiting[next(iter(self._waiting))]
            elif data.startswith(COMMAND_NAME, HEADER):
                began = self._waiting.pop(self._key(data, COMMAND_NAME), None)
                if began is not None:
                    latencies.append(_came(ancillary) - began)

    @staticmethod
    def _key(data, name):
        _, session, seq = BEGINNING.unpack_from(data, HEADER + len(name))
        return session, seq


def _came(ancillary):
    seconds, nanoseconds = struct.unpack("qq", ancillary[0][2])
    return seconds + nanoseconds * 1e-9
