"""How learning went in experiments side by side: every seed, median and quartiles over the seeds."""

import matplotlib.pyplot as plt
import numpy as np

from limphome_lab.show.figures import style

PANELS = (  # (label of the axis, value of an episode, statistic over the running window, scale)
    ("duration [s]", lambda episode: episode.duration_s, np.median, "log"),
    ("|lateral error| [m]", lambda episode: abs(episode.lateral_error_m), np.median, "linear"),
    ("reached the goal [%]", lambda episode: 100.0 * (episode.outcome == "goal"), np.mean, "linear"),
    ("total reward", lambda episode: episode.reward, np.median, "symlog"),
)


def draw(experiments):
    """`experiments`: of show/experiments.py."""
    figure, grid = plt.subplots(2, 2, figsize=(8.4, 6.0), sharex=True, layout="constrained")
    for axes, panel in zip(grid.flat, PANELS, strict=True):
        for number, experiment in enumerate(experiments):
            course(axes, experiment.runs, panel[1], panel[2], number)
        axes.set_ylabel(panel[0])
        _scale(axes, panel)
    for axes in grid[1]:
        axes.set_xlabel("episode")
    limits(grid[0, 0], experiments)
    figure.suptitle(f"How learning went, {told_window(experiments)}; goals: running means", fontsize=11)
    legend(figure, experiments)
    return figure


def limits(axes, experiments):
    axes.set_xlim(0, max(len(run.episodes) for each in experiments for run in each.runs) + 1)


def told_window(experiments):
    windows = sorted({style.window(len(run.episodes)) for each in experiments for run in each.runs})
    return f"running medians of {' or '.join(map(str, windows))} episodes"


def course(axes, runs, value, statistic, number):
    """`value` of an episode in the course of the runs of experiment `number`, by a running `statistic`."""
    colour, dash, _ = style.series(number)
    courses = [
        style.running([value(episode) for episode in run.episodes], statistic, style.window(len(run.episodes)))
        for run in runs
    ]
    shared = min(map(len, courses))
    number = np.arange(1, shared + 1)
    for course in courses:
        axes.plot(np.arange(1, len(course) + 1), course, color=colour, linewidth=0.7, alpha=0.35)
    lower, median, upper = np.quantile([course[:shared] for course in courses], [0.25, 0.5, 0.75], axis=0)
    if len(courses) > 1:
        axes.fill_between(number, lower, upper, color=colour, alpha=0.2, linewidth=0)
    axes.plot(number, median, color=colour, linestyle=dash, linewidth=2)


def _scale(axes, panel):
    label, _, _, scale = panel
    if scale == "symlog":
        axes.set_yscale("symlog", linthresh=10)
    else:
        axes.set_yscale(scale)
    if scale == "log":
        axes.yaxis.set_major_formatter("{x:g}")
    if label.endswith("[%]"):
        axes.set_ylim(-3, 103)
    elif scale == "linear":
        axes.set_ylim(bottom=0)


def legend(figure, experiments):
    """Letters, and behind them what tells the experiments apart, as far as there is room."""
    handles, labels = [], []
    for number, (experiment, name) in enumerate(zip(experiments, short_names(experiments), strict=True)):
        colour, dash, _ = style.series(number)
        handles.append(plt.Line2D([], [], color=colour, linestyle=dash, linewidth=2))
        labels.append(f"{name}{', ' if name else ''}{seeds(len(experiment.runs))}")
    figure.legend(handles, labels, loc="outside lower center", ncols=1 if max(map(len, labels)) > 40 else 3)


def seeds(count):
    return f"{count} seeds" if count > 1 else "1 seed"


def short_names(experiments):
    """A letter each, and of the keys that differ as few as tell them all apart, without their sections."""
    if len(experiments) == 1:
        return [""]
    keys = telling_keys([experiment.differs for experiment in experiments])
    return [
        f"{each.letter}: " + ", ".join(f"{key.rpartition('.')[2]} {each.differs[key]}" for key in keys)
        for each in experiments
    ]


def telling_keys(differs):
    """Of each key the one that tells most apart, until all are."""
    keys = []

    def kinds(chosen):
        return len({tuple(each[key] for key in chosen) for each in differs})

    while kinds(keys) < len(differs):
        keys.append(max((key for key in differs[0] if key not in keys), key=lambda key: kinds([*keys, key])))
    return keys
