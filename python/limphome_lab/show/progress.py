"""How far a training run has come: a live line on a terminal, else a line now and then."""

import shutil
import statistics
import sys
import time
from collections import deque

RECENT = 50  # episodes in the running figures
TERMINAL_EVERY_S = 0.2
LINE_EVERY_S = 10.0
BAR_WIDTH, LEAST_BAR = 24, 6
WIDTH = 79  # of a line where there is no terminal to ask


def clock(seconds):
    minutes, seconds = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{seconds:02}" if hours else f"{minutes}:{seconds:02}"


class Progress:
    """Feed it rows of episodes.csv as they come; those up to episode `done` are of an earlier part of the run,
    and those told before are passed over.

    It counts the rows, as those of an evaluation are numbered on from the training's."""

    def __init__(self, total, done=0, quiet=False, stream=None):
        self.total = total
        self.earlier = self.done = done
        self.quiet = quiet
        self.stream = stream or sys.stderr
        self.live = self.stream.isatty()
        self.began = time.monotonic()
        self.simulated_s = 0.0
        self.recent = deque(maxlen=RECENT)  # (episode, wall time at which it was seen)
        self.shown_at = float("-inf") if self.live else self.began

    def update(self, episodes):
        now = time.monotonic()
        for episode in episodes:
            if episode.episode <= self.earlier:
                continue
            self.earlier = episode.episode  # a table that was cut back is read anew
            self.done += 1
            self.simulated_s += episode.duration_s
            self.recent.append((episode, now))
        if not self.quiet and now - self.shown_at >= (TERMINAL_EVERY_S if self.live else LINE_EVERY_S):
            self._show(now)

    def close(self):
        """Shows the last state and leaves the line."""
        if not self.quiet:
            self._show(time.monotonic())
            if self.live:
                self.stream.write("\n")

    def _show(self, now):
        self.shown_at = now
        if self.live:
            width = shutil.get_terminal_size().columns - 1
            self.stream.write(f"\r{self.text(now, width)[:width]:<{width}}")
        else:
            self.stream.write(f"{self.text(now)}\n")
        self.stream.flush()

    def text(self, now, width=WIDTH):
        """In at most `width` characters: where it is too long, what matters less is left out; the bar has the rest."""
        count = f"{self.done:>{len(str(self.total))}}/{self.total}"
        taken = clock(now - self.began)
        if not self.recent:
            return self._with_bar(f"episode {count}", taken, width)
        taken += f", {self._left(now)} left"
        episodes = [episode for episode, _ in self.recent]
        goals = sum(episode.outcome == "goal" for episode in episodes) / len(episodes)
        reward = statistics.median(episode.reward for episode in episodes)
        recent = f"{taken}; last {len(episodes)}: {goals:.0%} goals, reward {reward:.1f}"
        factor = self.simulated_s / max(now - self.began, 1e-3)
        for name, rest in (
            (f"episode {count}", f"{recent}, {factor:.0f}x real time"),
            (f"episode {count}", recent),
            (count, recent),
            (count, f"{taken}; {goals:.0%} goals"),
        ):
            if len(name) + len(rest) + LEAST_BAR + len(" [] ") <= width:
                return self._with_bar(name, rest, width)
        return self._with_bar(count, taken, width)

    def _with_bar(self, before, after, width):
        room = min(BAR_WIDTH, max(LEAST_BAR, width - len(before) - len(after) - len(" [] ")))
        filled = round(min(self.done / self.total, 1.0) * room)
        return f"{before} [{'#' * filled}{'.' * (room - filled)}] {after}"

    def _left(self, now):
        """Time left at the pace of the recent episodes, which get shorter as the robot learns."""
        since = self.recent[0][1] if len(self.recent) == RECENT else self.began
        pace = max(now - since, 1e-3) / len(self.recent)
        return clock((self.total - self.done) * pace)
