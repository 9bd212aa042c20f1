"""Experiments side by side: when each seed had learned, and how it drove at its end."""

import matplotlib.pyplot as plt
import numpy as np

from limphome_lab.show import learned
from limphome_lab.show.figures import courses, style

SPREAD = 0.28  # of the seeds of an experiment, so that equal ones can be told apart
PANELS = (
    ("n", "learned at [episode]"),
    ("duration_s", f"duration of the last {learned.LAST} [s]"),
    ("lateral_error_m", f"|lateral error| of the last {learned.LAST} [m]"),
)


def draw(experiments, found):
    """`experiments`: of show/experiments.py; `found`: what study/compare.py makes of each, as its JSON has it."""
    figure, grid = plt.subplots(
        1, len(PANELS), figsize=(10, 1.9 + 0.55 * len(found)), sharey=True, layout="constrained", squeeze=False
    )
    longest = max(seed["episodes"] for each in found for seed in each["seeds"])
    never = 1.25 * longest
    for axes, (measure, label) in zip(grid[0], PANELS, strict=True):
        for row, each in enumerate(found):
            _experiment(axes, row, each, measure, never)
        axes.set_xlabel(label)
        axes.grid(visible=False, axis="y")
    if any(seed["n"] is None for each in found for seed in each["seeds"]):
        _never(grid[0, 0], never, longest)
    grid[0, 0].set_xlim(left=-0.04 * never)
    grid[0, 0].set_ylim(len(found) - 0.4, -0.6)
    names = [f"{each['letter']}  {each['learned']} of {each['runs']} learned" for each in found]
    grid[0, 0].set_yticks(range(len(found)), names)
    figure.suptitle("Every seed; bar and line: quartiles and median", fontsize=11)
    if len(found) > 1:
        looks = [style.series(number) for number in range(len(found))]
        handles = [plt.Line2D([], [], color=colour, marker=marker, linestyle="") for colour, _, marker in looks]
        labels = courses.short_names(experiments)
        figure.legend(handles, labels, loc="outside lower center", ncols=1 if max(map(len, labels)) > 40 else 3)
    return figure


def _experiment(axes, row, each, measure, never):
    colour, _, marker = style.series(row)
    values = [never if seed[measure] is None else seed[measure] for seed in each["seeds"]]
    lower, median, upper = (never if value is None else value for value in each[f"quartiles_{measure}"])
    axes.barh(row, upper - lower, left=lower, height=2.4 * SPREAD, color=colour, alpha=0.2)
    axes.plot([median, median], [row - 1.2 * SPREAD, row + 1.2 * SPREAD], color=colour, linewidth=2)
    offsets = np.linspace(-SPREAD, SPREAD, len(values)) if len(values) > 1 else [0]
    axes.scatter(values, row + np.asarray(offsets), s=20, color=colour, marker=marker, linewidths=0, alpha=0.9)


def _never(axes, never, longest):
    """Where those are that have not learned."""
    axes.axvline((never + longest) / 2, color=style.FAINT, linewidth=1)
    ticks = [tick for tick in plt.MaxNLocator(4, integer=True).tick_values(0, longest) if tick < 0.95 * longest]
    axes.set_xticks([*ticks, never], [*(f"{tick:g}" for tick in ticks), "never"])
    axes.set_xlim(right=1.06 * never)
