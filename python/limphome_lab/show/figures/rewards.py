"""What the total reward consists of, term by term: every seed, median and quartiles over the seeds."""

import matplotlib.pyplot as plt
import numpy as np

from limphome_lab.show.figures import courses

TERMS = {
    "reward_motion": "motion, r(1) of (8)",
    "reward_goal": "goal, r(2) of (9)",
    "reward_stability": "stability, r(3) of (12)",
    "reward_tumble": "tumbling",
}


def draw(experiments):
    """`experiments`: of show/experiments.py."""
    figure, grid = plt.subplots(2, 2, figsize=(8.4, 6.0), sharex=True, layout="constrained")
    for axes, (name, label) in zip(grid.flat, TERMS.items(), strict=True):
        # there is a goal, or a tumble, or there is none: a median would be nothing or all
        statistic = np.mean if name in ("reward_goal", "reward_tumble") else np.median
        for number, experiment in enumerate(experiments):
            courses.course(axes, experiment.runs, lambda episode, name=name: getattr(episode, name), statistic, number)
        axes.set_title(label, fontsize=10)
        if name in ("reward_motion", "reward_stability"):
            axes.set_yscale("symlog", linthresh=10)  # the first are hundreds of times as large as the last
    grid[1, 1].set_ylim(top=0.5, bottom=min(-1, grid[1, 1].get_ylim()[0]))
    for axes in grid[1]:
        axes.set_xlabel("episode")
    for axes in grid[:, 0]:
        axes.set_ylabel("sum over the episode")
    courses.limits(grid[0, 0], experiments)
    figure.suptitle(
        f"Terms of the reward, {courses.told_window(experiments)}; goal and tumbling: running means", fontsize=11
    )
    courses.legend(figure, experiments)
    return figure
