"""Figures of a study: every seed of every case."""

import matplotlib.pyplot as plt
import numpy as np

from limphome_lab.show import learned
from limphome_lab.show.figures import style

COLOURS = {"test": style.BLUE, "tuning": style.ORANGE}
SPREAD = 0.3  # of the seeds of a case, so that equal ones can be told apart
ROW_HEIGHT = 0.45  # [inch]


def draw_learned(outcomes):
    """When each seed had learned: {case: list of Outcome that have episodes}."""
    figure, axes = plt.subplots(figsize=(8.5, 1.6 + ROW_HEIGHT * len(outcomes)), layout="constrained")
    all_of_them = [outcome for each in outcomes.values() for outcome in each]
    longest = max(len(outcome.episodes) for outcome in all_of_them)
    never = 1.08 * longest  # where those are shown that have not learned
    for row, each in enumerate(outcomes.values()):
        for use, colour in COLOURS.items():
            found = [never if outcome.n is None else outcome.n for outcome in each if outcome.use == use]
            offset = np.linspace(-SPREAD, SPREAD, len(found)) if len(found) > 1 else 0
            axes.scatter(found, row + np.zeros(len(found)) + offset, s=18, color=colour, alpha=0.8, linewidths=0)
    axes.set_yticks(range(len(outcomes)), outcomes.keys())
    axes.set_ylim(len(outcomes) - 0.5, -0.5)
    axes.set_xscale("symlog", linthresh=20)
    axes.axvline(longest, color=style.FAINT, linewidth=1)
    ticks = [tick for tick in (0, 10, 20, 50, 100, 200, 500, 1000, 2000) if tick < 0.8 * longest]
    axes.set_xticks([*ticks, never], [*map(str, ticks), "never"])
    axes.minorticks_off()
    axes.set(xlabel="learned at n [episodes]", title="When each seed had learned")
    _legend_of_uses(axes, all_of_them)
    return figure


def draw_course(outcomes, limit_s):
    """How each seed of one case went on: medians and share of goals of the 20 episodes up to each."""
    figure, (duration, lateral, goals) = plt.subplots(1, 3, figsize=(11, 3.2), layout="constrained")
    for outcome in outcomes:
        windows = learned.windows(outcome.episodes)
        number = learned.WINDOW + np.arange(len(windows))
        look = {"color": COLOURS[outcome.use], "alpha": 0.55, "linewidth": 1}
        duration.plot(number, [learned.median_size(window, "duration_s") for window in windows], **look)
        lateral.plot(number, [learned.median_size(window, "lateral_error_m") for window in windows], **look)
        reached = [100 * np.mean([episode.outcome == "goal" for episode in window]) for window in windows]
        goals.plot(number, reached, **look)
    duration.axhline(limit_s, color=style.GREEN, linewidth=1, linestyle="--")
    lateral.axhline(learned.LATERAL_ERROR_M, color=style.GREEN, linewidth=1, linestyle="--")
    goals.axhline(100 * learned.GOALS / learned.WINDOW, color=style.GREEN, linewidth=1, linestyle="--")
    duration.set(ylabel="median duration [s]", yscale="log")
    duration.yaxis.set_major_formatter("{x:g}")
    duration.yaxis.set_minor_formatter("{x:g}")
    lateral.set(ylabel="median |lateral error| [m]", ylim=(0, None))
    goals.set(ylabel="reached the goal [%]", ylim=(-3, 103))
    for axes in (duration, lateral, goals):
        axes.set(xlabel="episode", xlim=(0, None))
    _legend_of_uses(goals, outcomes)
    return figure


def _legend_of_uses(axes, outcomes):
    """Tells the colours apart where both are there."""
    uses = [use for use in COLOURS if any(outcome.use == use for outcome in outcomes)]
    if len(uses) > 1:
        handles = [plt.Line2D([], [], color=COLOURS[use], marker="o", linestyle="") for use in uses]
        axes.legend(handles, [f"{use} seeds" for use in uses], loc="lower right", frameon=True, edgecolor="none")
