"""How learning went: duration, lateral error and share of goals, one above the other."""

import matplotlib.pyplot as plt
import numpy as np

from limphome_lab.show.figures import style


def draw(episodes):
    figure, (duration, lateral, goals) = plt.subplots(3, 1, figsize=(7.2, 7.0), sharex=True, layout="constrained")
    number = np.array([episode.episode for episode in episodes])
    _panel(duration, number, [episode.duration_s for episode in episodes], "duration [s]")
    duration.set_yscale("log")  # the first take a hundred times as long as the last
    _panel(lateral, number, [abs(episode.lateral_error_m) for episode in episodes], "|lateral error| [m]")
    lateral.set_ylim(bottom=0)
    reached = [100.0 * (episode.outcome == "goal") for episode in episodes]
    window = style.window(len(episodes))
    goals.plot(number, style.running(reached, np.mean, window), color=style.GREEN, linewidth=2)
    goals.set(ylabel="reached the goal [%]", xlabel="episode", ylim=(-3, 103), xlim=(number[0] - 1, number[-1] + 1))
    goals.xaxis.set_major_locator(plt.MaxNLocator(integer=True))
    duration.set_title(f"Single episodes, and their running median of {window}; goals as a running mean of {window}")
    return figure


def _panel(axes, number, values, label):
    size = 14 if len(number) < 200 else 5
    axes.scatter(number, values, s=size, color=style.FAINT, linewidths=0)
    axes.plot(number, style.running(values, window=style.window(len(number))), color=style.BLUE, linewidth=2)
    axes.set_ylabel(label)
