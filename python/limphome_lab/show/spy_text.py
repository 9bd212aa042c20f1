"""Rates and newest values of channels, once per second, as text: python -m limphome_lab.show.spy_text URL [CHANNEL...].

On a terminal it shows as much as there is room for: space and b turn the pages, q ends it.
"""

import os
import select
import shutil
import signal
import sys
import termios
import time
import tty
from dataclasses import dataclass

import lcm

from limphome_lab.messages import TYPES
from limphome_lab.show import constants

EVERY_S = 1.0
KEYS_EVERY_S = 0.1  # a person who presses a key is answered at once
CLEAR = "\x1b[H\x1b[J"
NEXT, BACK, END = " n", "bp", "q\x04"
MOST_VALUES = 8  # of an array are shown


@dataclass
class Channel:
    count: int = 0  # since the last screen
    octets: int = 0
    total: int = 0
    newest: bytes = b""


class TextSpy:
    def __init__(self, url, wanted=()):
        """`wanted`: names of channels; none: all."""
        self.lcm = lcm.LCM(url)
        self.wanted = wanted
        self.channels = {}
        # a reader that is too slow must lose messages, not memory
        self.lcm.subscribe(".*", self._receive).set_queue_capacity(1000)

    def _receive(self, name, data):
        if self.wanted and name not in self.wanted:
            return
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
    kind = TYPES[name].__name__.removesuffix("_t")
    return [f"{field:<21} {named(kind, field, getattr(message, field))}" for field in message.__slots__]


def named(kind, field, value):
    """A value by the constants of its field, where it has some; else as it is."""
    if isinstance(value, (list, tuple)) and field in constants.of_type(kind):
        return " ".join(named(kind, field, each) for each in value)
    name = constants.named(kind, field, value) if isinstance(value, (int, float)) else None
    return shown(value) if name is None else name


def shown(value):
    if isinstance(value, bytes):  # int8_t arrays
        value = list(value)
    if isinstance(value, (list, tuple)):
        if value and isinstance(value[0], (list, tuple)):
            return f"{len(value)} x {len(value[0])} values"
        more = " ..." if len(value) > MOST_VALUES else ""
        return " ".join(shown(each) for each in value[:MOST_VALUES]) + more
    return f"{value:.4g}" if isinstance(value, float) else str(value)


class Pages:
    """What of the lines is on the terminal, and the keys that turn over; leaving the context leaves it as it was."""

    def __enter__(self):
        self.page = 0
        self.by_keys = sys.stdin is not None and sys.stdin.isatty()
        if self.by_keys:
            self.before = termios.tcgetattr(sys.stdin)
            tty.setcbreak(sys.stdin)
        return self

    def __exit__(self, *_):
        if self.by_keys:
            termios.tcsetattr(sys.stdin, termios.TCSADRAIN, self.before)

    def pressed(self):
        """Whether a key has turned the page; SystemExit for the one that ends it."""
        if not self.by_keys or not select.select([sys.stdin], [], [], 0)[0]:
            return False
        typed = os.read(sys.stdin.fileno(), 64).decode(errors="replace")
        if not typed or any(key in END for key in typed):
            raise SystemExit(0)
        self.page += sum((key in NEXT) - (key in BACK) for key in typed)
        return True

    def of(self, lines, columns, rows):
        """The page, with a last line that tells how to turn over where there is more than one."""
        room = max(1, rows - 2)
        pages = max(1, -(-len(lines) // room))
        self.page %= pages
        part = [line[:columns] for line in lines[self.page * room : (self.page + 1) * room]]
        hint = "space: next, b: back, q: end; --channel NAME shows one"
        foot = [f"page {self.page + 1} of {pages}; {hint}"[:columns]] if pages > 1 else []
        return part + foot


def watch(spy, pages):
    """Shows what comes, until a signal or a key ends it."""
    lines, elapsed = [], 0.0
    while True:
        elapsed += spy.watch(KEYS_EVERY_S)
        turned = pages.pressed()
        if elapsed >= EVERY_S:
            lines, elapsed = spy.screen(elapsed), 0.0
        elif not turned:
            continue
        print(CLEAR + "\n".join(pages.of(lines, *shutil.get_terminal_size())), end="", flush=True)


def main():
    spy = TextSpy(sys.argv[1], sys.argv[2:])
    if sys.stdout.isatty():
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, lambda number, _: sys.exit(128 + number))
        with Pages() as pages:
            watch(spy, pages)
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C is how one leaves
    while True:
        print("\n".join(spy.screen(spy.watch(EVERY_S))) + "\n", flush=True)


if __name__ == "__main__":
    sys.exit(main())
