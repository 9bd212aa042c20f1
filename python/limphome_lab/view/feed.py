"""What a viewer hears of a running pair, and says to it: python -m limphome_lab.view.feed URL.

A pair's network has no way out, and a browser none in. So this process alone goes into that network; it writes the
newest messages to stdout some thirty times a second and takes on stdin what is to be said, a message each in the same
form: length of the channel's name, of the data (network order), name, data. It ends with stdin, and so with its parent.
"""

import contextlib
import json
import os
import select
import signal
import struct
import subprocess
import sys
import time

from limphome_lab import network
from limphome_lab.view.listen import Listener
from limphome_lab.view.operate import ASKED, Operating

HEADER = struct.Struct("!HI")
EVERY_S = 1 / 30
NICE = 5  # the pair comes first
READ = 1 << 16  # [bytes]


class Feed:
    """The other end: starts that process in the network of a pair, an entry of the registry."""

    def __init__(self, pair):
        words = [*network.join_prefix(pair["pid"]), sys.executable, "-m", "limphome_lab.view.feed", pair["url"]]
        self.process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0)
        os.set_blocking(self.process.stdout.fileno(), False)
        self._packer = Parser()

    def newest(self):
        """[(channel, encoded message)] that have come; None where the process has ended."""
        found = []
        while True:
            data = self.process.stdout.read(READ)
            if data is None:
                return found
            if not data:
                return found or None
            found += self._packer.feed(data)

    def say(self, channel, data):
        with contextlib.suppress(BrokenPipeError):
            self.process.stdin.write(packed(channel, data))

    def close(self):
        self.process.stdin.close()
        self.process.terminate()
        self.process.wait()
        self.process.stdout.close()


class Parser:
    """Puts messages together again."""

    def __init__(self):
        self._bytes = b""

    def feed(self, data):
        self._bytes += data
        found = []
        while len(self._bytes) >= HEADER.size:
            name, size = HEADER.unpack_from(self._bytes)
            end = HEADER.size + name + size
            if len(self._bytes) < end:
                break
            found.append(
                (self._bytes[HEADER.size : HEADER.size + name].decode(), self._bytes[HEADER.size + name : end])
            )
            self._bytes = self._bytes[end:]
        return found


def packed(channel, data):
    name = channel.encode()
    return HEADER.pack(len(name), len(data)) + name + data


def main():
    import lcm

    signal.signal(signal.SIGINT, signal.SIG_IGN)  # who started this ends it, by closing stdin
    os.nice(NICE)
    listener = Listener(sys.argv[1])
    bus = lcm.LCM(sys.argv[1])  # to speak alone: without a subscription liblcm receives nothing
    operating = Operating(sys.argv[1], lambda channel, data: heard.append(packed(channel, data)))
    heard = []
    parser = Parser()
    due = time.monotonic()
    while True:
        due = max(due + EVERY_S, time.monotonic())
        while (left := due - time.monotonic()) > 0:
            if not select.select([sys.stdin], [], [], left)[0]:
                continue
            said = os.read(sys.stdin.fileno(), READ)
            if not said:
                operating.let_go()
                return 0
            for channel, data in parser.feed(said):
                if channel == ASKED:
                    operating.obey(json.loads(data))
                else:
                    bus.publish(channel, data)
        operating.answer()
        heard += [packed(*message) for message in listener.newest()]
        try:
            sys.stdout.buffer.write(b"".join(heard))
            sys.stdout.buffer.flush()
        except BrokenPipeError:
            operating.let_go()
            return 0
        heard.clear()


if __name__ == "__main__":
    sys.exit(main())
