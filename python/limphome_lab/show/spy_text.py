"""Rates and newest values of every channel, once per second, as text: python -m limphome_lab.show.spy_text URL."""

import shutil
import signal
import sys
import time
from dataclasses import dataclass

import lcm

from limphome_lab.messages import TYPES

EVERY_S = 1.0
CLEAR = "\x1b[H\x1b[J"
MOST_VALUES = 8  # of an array are shown


@dataclass
class Channel:
    count: int = 0  # since the last screen
    octets: int = 0
    total: int = 0
    newest: bytes = b""


class TextSpy:
    def __init__(self, url):
        self.lcm = lcm.LCM(url)
        self.channels = {}
        # a reader that is too slow must lose messages, not memory
        self.lcm.subscribe(".*", self._receive).set_queue_capacity(1000)

    def _receive(self, name, data):
        channel = self.channels.setdefault(name, Channel())
        channel.count += 1
        channel.total += 1
        channel.octets += len(data)
        channel.newest = data

    def watch(self, seconds):
        """Takes in messages for a while; returns for how long [s]."""
        begin = time.monotonic()
        while (left := seconds - (time.monotonic() - begin)) > 0:
            self.lcm.handle_timeout(max(1, int(left * 1000)))
        return time.monotonic() - begin

    def screen(self, seconds):
        lines = [f"{'channel':<20} {'messages':>10} {'Hz':>9} {'kB/s':>9}"]
        for name, channel in sorted(self.channels.items()):
            lines.append(
                f"{name:<20} {channel.total:>10} {channel.count / seconds:>9.1f} "
                f"{channel.octets / seconds / 1000:>9.1f}"
            )
            channel.count = channel.octets = 0
        for name, channel in sorted(self.channels.items()):
            lines += ["", name, *(f"  {line}" for line in values(name, channel.newest))]
        return lines


def values(name, data):
    """Lines of `field value` of an encoded message."""
    if name not in TYPES:
        return [f"{len(data)} bytes of a type that is not ours"]
    try:
        message = TYPES[name].decode(data)
    except ValueError as error:
        return [f"{len(data)} bytes that do not decode: {error}"]
    return [f"{field:<21} {shown(getattr(message, field))}" for field in message.__slots__]


def shown(value):
    if isinstance(value, bytes):  # int8_t arrays
        value = list(value)
    if isinstance(value, (list, tuple)):
        if value and isinstance(value[0], (list, tuple)):
            return f"{len(value)} x {len(value[0])} values"
        more = " ..." if len(value) > MOST_VALUES else ""
        return " ".join(shown(each) for each in value[:MOST_VALUES]) + more
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def main():
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C is how one leaves
    spy = TextSpy(sys.argv[1])
    while True:
        lines = spy.screen(spy.watch(EVERY_S))
        if sys.stdout.isatty():
            columns, rows = shutil.get_terminal_size()
            print(CLEAR + "\n".join(line[:columns] for line in lines[: rows - 1]), end="", flush=True)
        else:
            print("\n".join(lines) + "\n", flush=True)


if __name__ == "__main__":
    sys.exit(main())
