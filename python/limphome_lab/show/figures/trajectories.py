"""Fig. 7: the way of the robot in the first and in the last episode, seen from above.

Each is drawn from where it started, its straight line upwards. On the paper's rolling path the line goes through the
start, along where the robot faced; on any other it may lie beside it.
"""

import matplotlib.pyplot as plt

from limphome_lab.show.figures import style

WIDTH = 6.0  # of the figure [in]
BESIDE_AXES = 0.9  # height of title, labels and legend, less what the labels take of the width [in]


def draw(first, last):
    """`first`, `last`: (episode_t, [robot_state_t])."""
    figure, axes = plt.subplots(layout="constrained")
    for (episode, states), colour, width in ((first, style.ORANGE, 1.4), (last, style.BLUE, 2.2)):
        way = style.episode_frame([state.position[:2] for state in states], episode.start, episode.line_heading)
        axes.plot(
            way[:, 0],
            way[:, 1],
            color=colour,
            linewidth=width,
            marker=".",
            markersize=4,
            label=f"episode {episode.episode} ({episode.duration:.1f} s)",
            zorder=3,
        )
        axes.plot(*way[-1], marker="o", markersize=7, color=colour, markeredgecolor="white", zorder=4)
    episodes = [episode for episode, _ in (first, last)]
    for episode in episodes:
        axes.axhline(episode.goal_distance, color=style.GREEN, linestyle="--", linewidth=1.4, zorder=2)
    axes.plot([], [], color=style.GREEN, linestyle="--", linewidth=1.4, label="goal line")
    axes.plot(0, 0, marker="^", markersize=10, color=style.INK, label="start", linestyle="none", zorder=5)
    figure.set_size_inches(WIDTH, BESIDE_AXES + WIDTH * _limits(axes, episodes))
    axes.set(
        xlabel="x, to the right of the start [m]",
        ylabel="y, along the line of the episode [m]",
        title="Way of the robot in the first and the last episode",
    )
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure


def _limits(axes, episodes):
    """Equal scales, the start in the middle, and room for all the robot did; returns height over width."""
    axes.set_aspect("equal")
    goal_distance = max(episode.goal_distance for episode in episodes)
    low, high = axes.get_xlim()
    reach = max(abs(low), abs(high), goal_distance / 2)
    axes.set_xlim(-reach, reach)
    low, high = axes.get_ylim()
    low, high = min(low, -0.15 * goal_distance), max(high, 1.15 * goal_distance)
    axes.set_ylim(low, high)
    for episode in episodes:
        beside = episode.start_lateral_error  # of the start, to the left of the line
        axes.plot(
            [beside, beside], [0, episode.goal_distance], color=style.FAINT, linewidth=1.0, linestyle=":", zorder=1
        )
    axes.xaxis.set_major_locator(plt.MaxNLocator(7, steps=[1, 2, 5, 10]))
    return (high - low) / (2 * reach)
