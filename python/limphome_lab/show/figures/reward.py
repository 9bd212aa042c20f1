"""Fig. 8: total reward of each episode."""

import matplotlib.pyplot as plt
import numpy as np

from limphome_lab.show.figures import style


def draw(episodes):
    figure, axes = plt.subplots(figsize=(7.2, 4.2), layout="constrained")
    number = np.array([episode.episode for episode in episodes])
    reward = np.array([episode.reward for episode in episodes])
    tumbled = np.array([episode.outcome == "tumble" for episode in episodes])
    size = 14 if len(episodes) < 200 else 5
    axes.scatter(number[~tumbled], reward[~tumbled], s=size, color=style.FAINT, linewidths=0, label="one episode")
    if tumbled.any():
        axes.scatter(
            number[tumbled],
            reward[tumbled],
            s=3 * size,
            color=style.RED,
            marker="x",
            linewidths=1,
            label="one episode, tumbled",
        )
    axes.plot(
        number, style.running(reward), color=style.BLUE, linewidth=2, label=f"running median of {style.MEDIAN_WINDOW}"
    )
    axes.set(
        xlabel="episode",
        ylabel="total reward (linear within 10, then logarithmic)",
        title="Total reward of each episode",
    )
    axes.set_xlim(0, number[-1] + 1)
    axes.set_yscale("symlog", linthresh=10)  # the first are hundreds of times as large as the last
    axes.legend(loc="lower right", framealpha=0.9, frameon=True, edgecolor="none")
    return figure
