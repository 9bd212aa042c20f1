"""Both programs under forged datagrams: python datagrams.py KIND URL FOLDER OPTION...

Starts the two on the network that it is in, sends the datagrams of KIND to their group over and over for as long as the
controller runs, and prints JSON: both exit codes, the most memory of either [kB] and how many datagrams were sent.

LCM has a message that is too large for one datagram in parts, `LC03` with a header of 20 bytes each, and liblcm puts
them where their headers say.
"""

import json
import random
import signal
import socket
import struct
import subprocess
import sys
import time
from pathlib import Path

from limphome_lab import network, paths
from limphome_lab.channels import COMMAND, STATE

LARGEST = 65507  # bytes that UDP over IPv4 carries
NAMES = [name.encode() for name in (STATE, COMMAND)]  # heard by the controller, by the simulator
BURST = 20  # datagrams between two short pauses


def whole(payload, seq=1):
    """A message in one datagram; `payload` is the channel's name, 0 and the data."""
    return struct.pack(">4sI", b"LC02", seq) + payload


def part(data=b"", seq=1, size=1000, offset=0, number=1, count=2):
    return struct.pack(">4sIIIHH", b"LC03", seq, size, offset, number, count) + data


def first(name, data=bytes(100), **fields):
    """The first part of a message, which has the channel's name."""
    return part(name + b"\0" + data, **{"number": 0, **fields})


def with_first(*parts, **fields):
    """A sound first part on each channel that is heard, and behind each the others."""
    return [datagram for name in NAMES for datagram in (first(name, **fields), *parts)]


def noise():
    dice = random.Random(1)
    return [dice.choice([b"LC02", b"LC03"]) + dice.randbytes(dice.randrange(100)) for _ in range(2000)]


KINDS = {
    "none": [],
    "offset of a part near 2^32": [
        *(first(name, offset=2**32 - 16) for name in NAMES),
        *with_first(part(bytes(100), offset=2**32 - 16)),
    ],
    "part behind the end of its message": with_first(part(bytes(100), offset=950), part(bytes(100), offset=2**31)),
    "part larger than its message": [*(first(name, size=10) for name in NAMES), *with_first(part(bytes(2000)))],
    "channel of a part without an end": [part(b"L" * n, offset=2**32 - n, number=0) for n in range(1, 100)],
    "header of a part cut short": [datagram[:n] for n in range(21) for datagram in (part(), *with_first())],
    "message of no parts": with_first(count=0),
    "part numbered beyond their count": with_first(*(part(bytes(10), number=n) for n in range(2, 65536, 999))),
    "the same part over and over": with_first(*[part(bytes(10))] * 20, count=20),
    "last parts alone": [part(bytes(10), seq=seq, number=65535, count=1) for seq in range(500)],
    "message of 4 GB": with_first(part(bytes(10), size=2**32 - 1, offset=2**31), size=2**32 - 1),
    "messages of 256 MB": [
        datagram
        for seq in range(1000)
        for datagram in with_first(part(bytes(60000), size=2**28, offset=2**16 * seq), seq=seq, size=2**28, count=9)
    ],
    "a million beginnings": [first(name, bytes(9), seq=seq) for seq in range(2**19) for name in NAMES],
    "channel without an end": [whole(name) for name in NAMES] + [whole(b"L" * n) for n in (1, 63, 64, LARGEST - 8)],
    "channel with a long name": [whole(name * n + b"\0") for name in NAMES for n in (2, 5, 4000)],
    "nothing, and the largest": [
        *(b"", whole(b""), whole(b"\0")),
        *(whole((name + b"\0").ljust(LARGEST - 8, b"~")) for name in NAMES),
    ],
    "noise": noise(),
}


def peak_memory(process):
    """The most that it had at a time [kB]."""
    status = Path(f"/proc/{process.pid}/status").read_text()
    return next((int(line.split()[1]) for line in status.splitlines() if line.startswith("VmHWM")), 0)


def fire(datagrams, running):
    """Sends until `running()` is false; returns how many."""
    sent = 0
    group = (network.GROUP, network.PORT)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
        while running():
            for _ in range(BURST if datagrams else 0):
                sender.sendto(datagrams[sent % len(datagrams)], group)
                sent += 1
            time.sleep(0.001)
    return sent


def main():
    kind, url, folder, *options = sys.argv[1:]
    common = ["--lcm-url", url, *options]
    plant = subprocess.Popen([paths.program("simulator"), *common])
    controller = subprocess.Popen([paths.program("controller"), *common, "--out", folder])
    memory = []

    def running():
        memory.append(max(peak_memory(plant), peak_memory(controller)))
        return controller.poll() is None and plant.poll() is None

    sent = fire(KINDS[kind], running)
    if plant.poll() is not None:
        controller.terminate()
    codes = {"controller": controller.wait(60)}
    plant.send_signal(signal.SIGTERM)
    codes["simulator"] = plant.wait(60)
    print(json.dumps({**codes, "sent": sent, "memory": max(memory)}))


if __name__ == "__main__":
    main()
