"""Live plots: reward terms of the latest decisions, stability margin, reward of all episodes."""

from collections import deque

import numpy as np

LATEST = 240  # decisions, or moments, that a plot shows
MOST_EPISODES = 3000
HEIGHT = 150  # [px]
# colours of Okabe and Ito
TERMS = {"motion": "#0072b2", "goal": "#009e73", "stability": "#e69f00", "tumble": "#d55e00"}
INK = "#5c6670"
GRID = {"stroke": "#e3e7eb", "width": 1}


class Curves:
    """Puts its plots where the caller's `with` is. `add_*` collect; `draw` shows it, call that a few times a second."""

    def __init__(self, gui):
        self._decisions = deque(maxlen=LATEST)
        self._margins = deque(maxlen=LATEST)
        self._episodes = deque(maxlen=MOST_EPISODES)
        self._count = 0
        self._plots = {
            "reward": _plot(gui, "reward terms of each decision", "decision", TERMS),
            "margin": _plot(gui, "stability margin [m]", "plant time [s]", {"margin": "#0072b2"}),
            "episodes": _plot(
                gui, "reward of each episode", "episode", {"reward": "#0072b2", "median of 21": "#d55e00"}
            ),
        }
        self._stale = set()

    def clear(self):
        for each in (self._decisions, self._margins, self._episodes):
            each.clear()
        self._count = 0
        self._stale = set(self._plots)

    def add_decision(self, decision):
        self._count += 1
        if decision.learned:
            self._decisions.append((self._count, *(getattr(decision, f"reward_{term}") for term in TERMS)))
            self._stale.add("reward")

    def add_margin(self, time, margin):
        if self._margins and time < self._margins[-1][0]:  # a new session
            self._margins.clear()
        self._margins.append((time, margin))
        self._stale.add("margin")

    def add_episode(self, number, reward):
        self._episodes.append((number, reward))
        self._stale.add("episodes")

    def draw(self):
        rows = {"reward": self._decisions, "margin": self._margins, "episodes": self._episodes}
        for name in self._stale:
            width = len(self._plots[name].series)
            data = np.array(rows[name], dtype=float).T if rows[name] else np.zeros((width, 0))
            if name == "episodes" and rows[name]:
                data = np.vstack([data, _running_median(data[1])])
            self._plots[name].data = tuple(data)
        self._stale.clear()


def _plot(gui, title, across, curves):
    axis = {"stroke": INK, "grid": GRID, "font": "11px sans-serif"}
    return gui.add_uplot(
        data=tuple(np.zeros((len(curves) + 1, 0))),
        series=(
            {"label": across},
            *(
                {"label": label, "stroke": colour, "width": 1.5, "points": {"show": False}}
                for label, colour in curves.items()
            ),
        ),
        scales={"x": {"time": False}},
        axes=({**axis, "size": 28}, {**axis, "size": 44}),
        title=title,
        height=HEIGHT,
        legend={"show": len(curves) > 1, "live": False},
    )


def _running_median(values, half=10):
    return [np.median(values[max(0, i - half) : i + half + 1]) for i in range(len(values))]
