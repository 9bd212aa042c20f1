"""The bus for one who looks on: takes what it can look at and costs those who talk next to nothing.

liblcm wakes its reader for every datagram, thousands a second while a pair trains. Here the kernel lets through the
channels that are wanted alone, a socket is read some thirty times a second, and what comes often has a socket with room
for few: what finds no room is dropped where it costs least.
"""

import array
import contextlib
import re
import socket
import struct

from limphome_lab.channels import DECISION, EPISODE, POSE, STATE, STATUS

MAGIC = b"LC02"  # of a message in one datagram, then its number; docs/protocol.md, lcmtypes/udpm
HEADER = 8  # [bytes] before the channel's name
UDP_HEADER = 8  # [bytes] a filter sees the datagram from there on
MOST_BYTES = 65536  # of a datagram
MOST_AT_ONCE = 500  # datagrams are looked at in one go
FEW = 2304  # [bytes] the least buffer that the kernel gives; room for two or three
MANY = 1 << 20

# what comes as often as the robot decides, and what does not
OFTEN = (DECISION, STATE)
RARELY = (POSE, STATUS, EPISODE)

SO_ATTACH_FILTER = 26
IP_MULTICAST_ALL = 49
LOAD, EQUAL, RETURN = 0x20, 0x15, 0x06  # classic BPF: a word at an offset; jump where it is k; end
LOAD_BYTE = 0x30


class Listener:
    """What has come on the bus at `url` (udpm://GROUP:PORT?...) since the last look."""

    def __init__(self, url):
        group, port = re.match(r"udpm://([\d.]+):(\d+)", url).groups()
        buffers = [((channel,), FEW) for channel in OFTEN] + [(RARELY, MANY)]
        self._sockets = [_open(group, int(port), channels, room) for channels, room in buffers]

    def newest(self):
        """[(channel, encoded message)]: of OFTEN and LIMPHOME_POSE the newest, of the others all in order."""
        found = []
        for each in self._sockets:
            found += _drain(each)
        last = {channel: index for index, (channel, _) in enumerate(found)}
        return [
            (channel, data)
            for index, (channel, data) in enumerate(found)
            if channel in (EPISODE, STATUS) or index == last[channel]
        ]

    def close(self):
        for each in self._sockets:
            each.close()


def _open(group, port, channels, room):
    bus = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    bus.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    bus.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, room)
    bus.setsockopt(socket.IPPROTO_IP, IP_MULTICAST_ALL, 0)
    _attach(bus, _filter(channels))
    bus.bind((group, port))
    bus.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, socket.inet_aton(group) + socket.inet_aton("0.0.0.0"))
    bus.setblocking(False)
    return bus


def _drain(bus):
    found = []
    with contextlib.suppress(BlockingIOError):
        for _ in range(MOST_AT_ONCE):
            datagram = bus.recv(MOST_BYTES)
            name, zero, data = datagram[HEADER:].partition(b"\0")
            if datagram.startswith(MAGIC) and zero:
                found.append((name.decode(errors="replace"), data))
    return found


def _filter(channels):
    """Instructions (code, jump if true, jump if false, k) that accept messages on these channels and nothing else. They
    may accept more on a kernel that cannot filter; the caller looks at the names anyway."""
    accept, reject = (RETURN, 0, 0, 0xFFFFFFFF), (RETURN, 0, 0, 0)
    program = [(LOAD, 0, 0, UDP_HEADER), (EQUAL, 1, 0, int.from_bytes(MAGIC, "big")), reject]
    for channel in channels:
        name = channel.encode() + b"\0"
        tests = []
        for at in range(0, len(name) - len(name) % 4, 4):
            tests.append((LOAD, at, name[at : at + 4]))
        for at in range(len(name) - len(name) % 4, len(name)):
            tests.append((LOAD_BYTE, at, name[at : at + 1]))
        for left, (load, at, text) in zip(range(len(tests) - 1, -1, -1), tests, strict=True):
            # over the tests that are left and the end that accepts
            program.append((load, 0, 0, UDP_HEADER + HEADER + at))
            program.append((EQUAL, 0, 2 * left + 1, int.from_bytes(text, "big")))
        program.append(accept)
    return [*program, reject]


def _attach(bus, program):
    code = array.array("B", b"".join(struct.pack("=HBBI", *each) for each in program))
    bus.setsockopt(socket.SOL_SOCKET, SO_ATTACH_FILTER, struct.pack("@HP", len(program), code.buffer_info()[0]))
