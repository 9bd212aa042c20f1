"""How much of some work is done: a live line on a terminal, else a line now and then; nothing where it is short."""

import sys
import time

from limphome_lab.show.progress import LINE_EVERY_S, TERMINAL_EVERY_S, clock

QUIET_S = 2.0  # work that takes less is not worth a word
WIDTH = 79


class Share:
    """Tells on stderr of `total` units of work, named `what`."""

    def __init__(self, what, total):
        self.what = what
        self.total = max(total, 1)
        self.live = sys.stderr.isatty()
        self.began = time.monotonic()
        self.shown_at = None

    def update(self, done):
        now = time.monotonic()
        due = QUIET_S if self.shown_at is None else TERMINAL_EVERY_S if self.live else LINE_EVERY_S
        if now - (self.shown_at or self.began) < due:
            return
        self.shown_at = now
        share = min(done / self.total, 1.0)
        left = clock((now - self.began) * (1 - share) / share) if share > 0 else "?"
        text = f"{self.what} {share:4.0%}, {left} left"
        sys.stderr.write(f"\r{text:<{WIDTH}}" if self.live else f"{text}\n")
        sys.stderr.flush()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.live and self.shown_at is not None:
            sys.stderr.write("\n")
