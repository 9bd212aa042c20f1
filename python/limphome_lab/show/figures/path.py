"""The path and the robot's way along it, from one reset to the next, seen from above in the world frame."""

import matplotlib.pyplot as plt
import numpy as np

from limphome_lab.show.figures import style

WIDTH = 7.0  # of the figure [in]
BESIDE = 1.2  # height of title, labels and legend [in]
HALF_GOAL_LINE = 0.4  # as it is drawn [m]


def waypoints(text):
    """[n x 2] of the key `path` as it is printed, "to X Y, X Y ..."; n is 0 for "ahead"."""
    points = text.removeprefix("to ").split(",") if text.startswith("to ") else []
    return np.array([[float(number) for number in point.split()] for point in points]).reshape(-1, 2)


def draw(text, episodes, states):
    """`text`: the key `path`; `episodes` [episode_t] and `states` [robot_state_t] of one session."""
    first, points = episodes[0], waypoints(text)
    way = np.array([state.position[:2] for state in states])
    goals = [_goal_line(episode) for episode in episodes]
    if len(points) == 0:  # a line without an end is drawn as far as the robot was to go
        points = np.array([goals[-1].mean(axis=0)])
    figure, axes = plt.subplots(layout="constrained")
    axes.plot(*np.vstack([first.start, points]).T, color=style.FAINT, linewidth=1.4, label="path", zorder=1)
    if text != "ahead":
        axes.plot(*points.T, marker="s", color=style.INK, linestyle="none", label="waypoint", zorder=4)
    for goal in goals:
        axes.plot(*goal.T, color=style.GREEN, linestyle="--", linewidth=1.2, zorder=2)
    axes.plot([], [], color=style.GREEN, linestyle="--", linewidth=1.2, label="goal line")
    axes.plot(*way.T, color=style.BLUE, linewidth=1.8, marker=".", markersize=3, label="robot", zorder=3)
    axes.plot(*first.start, marker="^", markersize=10, color=style.INK, linestyle="none", label="start", zorder=5)
    axes.set_aspect("equal")
    axes.set(xlabel="x [m]", ylabel="y [m]", title=_title(episodes))
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    figure.set_size_inches(WIDTH, BESIDE + WIDTH * np.clip((top - bottom) / (right - left), 0.3, 1.5))
    figure.legend(loc="outside lower center", ncols=5)
    return figure


def _goal_line(episode):
    """Ends [2 x 2] of the goal line, as far as it is drawn, in the world frame."""
    along = np.array([np.cos(episode.line_heading), np.sin(episode.line_heading)])
    left = np.array([-along[1], along[0]])
    middle = np.array(episode.start) + episode.goal_distance * along - episode.start_lateral_error * left
    return np.array([middle - HALF_GOAL_LINE * left, middle + HALF_GOAL_LINE * left])


def _title(episodes):
    begin, end = episodes[0].episode, episodes[-1].episode
    told = f"Way of the robot in episodes {begin} to {end}, {sum(episode.duration for episode in episodes):.1f} s"
    return told + (f"; arrived {episodes[-1].waypoint_distance:.2f} m from the end" if episodes[-1].arrived else "")
