"""Every run of one experiment, a small picture each: how long its episodes took and how they ended."""

import math

import matplotlib.pyplot as plt
import numpy as np

from limphome_lab.show.figures import style

COLUMNS = 4
ENDS = {  # outcome: colour, marker
    "timeout": (style.ORANGE, "o"),
    "goal": (style.BLUE, "o"),
    "tumble": (style.RED, "x"),
}


def draw(episodes_of_seed, learned_after):
    """{seed: episodes} and {seed: episodes until it had learned, or None}."""
    columns = min(COLUMNS, len(episodes_of_seed))
    rows = math.ceil(len(episodes_of_seed) / columns)
    figure, grid = plt.subplots(
        rows,
        columns,
        figsize=(1 + 2.1 * columns, 0.9 + 1.6 * rows),
        sharex=True,
        sharey=True,
        squeeze=False,
        layout="constrained",
    )
    for axes, (seed, episodes) in zip(grid.flat, sorted(episodes_of_seed.items()), strict=False):
        draw_one(axes, episodes, learned_after[seed])
        axes.set_title(f"seed {seed}", fontsize=9, pad=2)
    for axes in grid.flat[len(episodes_of_seed) :]:
        axes.set_axis_off()
    grid[0, 0].set(xscale="log", yscale="log")
    figure.supxlabel("episode", fontsize=10)
    figure.supylabel("duration of the episode [s]", fontsize=10)
    handles = [
        plt.Line2D([], [], color=colour, marker=marker, markersize=4, linestyle="", label=outcome)
        for outcome, (colour, marker) in ENDS.items()
    ]
    figure.legend(handles=handles, loc="outside upper right", ncols=len(ENDS))
    return figure


def draw_one(axes, episodes, learned):
    number = np.array([episode.episode for episode in episodes])
    duration = np.array([episode.duration_s for episode in episodes])
    outcome = np.array([episode.outcome for episode in episodes])
    for name, (colour, marker) in ENDS.items():
        these = outcome == name
        axes.scatter(number[these], duration[these], s=4, marker=marker, color=colour, linewidths=0.6)
    if learned is not None:
        axes.axvline(learned + 1, color=style.GREEN, linewidth=1)
