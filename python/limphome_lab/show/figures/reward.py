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
    window = style.window(len(episodes))
    running = style.running(reward, window=window)
    axes.plot(number, running, color=style.BLUE, linewidth=2, label=f"running median of {window}")
    axes.set(
        xlabel="episode",
        ylabel="total reward",
        title="Total reward of each episode (linear within 10, then logarithmic)",
    )
    axes.set_xlim(number[0] - 1, number[-1] + 1)
    axes.set_yscale("symlog", linthresh=10)  # the first are hundreds of times as large as the last
    axes.set_ylim(min(-1, 1.5 * reward.min()), max(1, 1.5 * reward.max()))
    axes.xaxis.set_major_locator(plt.MaxNLocator(integer=True))
    axes.legend(loc="lower right", framealpha=0.9, frameon=True, edgecolor="none")
    return figure
