"""Use of actions: how often each actuator was driven in reverse, left still or driven forward, as learning went on."""

import matplotlib.pyplot as plt
import numpy as np

from limphome_lab.show.figures import style

STRETCHES = 12  # of the run, at most
LEVELS = (("reverse", style.ORANGE), ("still", "#d8dde3"), ("forward", style.BLUE))  # digits 0, 1, 2 of an action


def draw(robot, controlled, decisions):
    """`robot`: as limphome_lab.robot reads it; `controlled`: indices of actuators; `decisions`: of the whole run, or
    evenly chosen."""
    names = [robot.actuators[index].replace("_", " ") for index in controlled]
    episode = np.array([decision.episode for decision in decisions])
    action = np.array([decision.action for decision in decisions])
    edges = np.unique(np.linspace(episode.min(), episode.max() + 1, STRETCHES + 1).round().astype(int))
    figure, grid = plt.subplots(
        len(names), 1, figsize=(7.2, 1.5 + 1.25 * len(names)), sharex=True, squeeze=False, layout="constrained"
    )
    for k, (axes, name) in enumerate(zip(grid[:, 0], names, strict=True)):
        _levels(axes, edges, episode, action // 3**k % 3)
        axes.set(ylabel=name, ylim=(0, 100), yticks=(0, 50, 100))
    grid[-1, 0].set(xlabel="episode", xlim=(edges[0] - 0.5, edges[-1] - 0.5))
    figure.suptitle("Decisions in which each actuator was driven [%]", fontsize=11)
    handles = [plt.Rectangle((0, 0), 1, 1, color=colour) for _, colour in LEVELS]
    figure.legend(handles, [name for name, _ in LEVELS], loc="outside lower center", ncols=3)
    return figure


def _levels(axes, edges, episode, level):
    """Shares of the three levels in each stretch of episodes, one on the other."""
    stretch = np.digitize(episode, edges) - 1
    bottom = np.zeros(len(edges) - 1)
    for value, (_, colour) in enumerate(LEVELS):
        chosen = np.bincount(stretch[level == value], minlength=len(bottom))
        share = 100 * chosen / np.maximum(np.bincount(stretch, minlength=len(bottom)), 1)
        axes.bar(
            edges[:-1] - 0.5,
            share,
            np.diff(edges),
            bottom,
            align="edge",
            color=colour,
            edgecolor="white",
            linewidth=0.5,
        )
        bottom += share
    axes.grid(visible=False)
