"""Fig. 9: how the robot moves in one episode, at a few times, seen from the side and from above.

The frame is that of the episode: forward is along its straight line from the start, left is across it. The side view is
from the side of the failed crawler; from the left, forward points to the left. Only level ground is drawn: any other
lies elsewhere under each part of the robot.
"""

import matplotlib.pyplot as plt
import numpy as np

from limphome_lab.robot import read
from limphome_lab.show.figures import outline, style
from limphome_lab.show.figures.outline import FORWARD, LEFT, UP

SNAPSHOTS = 5


def draw(file, episode, states, level=True):
    """`level`: whether the ground is."""
    robot = read(file)
    chosen = [states[i] for i in np.unique(np.linspace(0, len(states) - 1, SNAPSHOTS).round().astype(int))]
    poses = [_parts(robot, episode, state) for state in chosen]
    points = np.vstack([part.points for parts in poses for part, _ in parts])
    low, high = points.min(axis=0) - 0.25, points.max(axis=0) + 0.25
    low, high = np.minimum(low, [-1, -1, -0.15]), np.maximum(high, [episode.goal_distance + 0.3, 1, 1.5])

    span = high - low
    panel = 3.2  # width [in]
    heights = [panel * span[UP] / span[FORWARD], panel * span[LEFT] / span[FORWARD]]
    figure, axes = plt.subplots(
        2,
        len(chosen),
        figsize=(panel * len(chosen) + 0.6, sum(heights) + 1.6),
        height_ratios=heights,
        sharex=True,
        sharey="row",
        squeeze=False,
        layout="constrained",
    )
    from_left = _failed_side(poses[0]) >= 0
    begin = episode.utime * 1e-6 - episode.duration
    for (side, above), state, parts in zip(axes.T, chosen, poses, strict=True):
        outline.view(side, parts, across=UP, nearness=lambda points: points[:, LEFT] if from_left else -points[:, LEFT])
        outline.view(above, parts, across=LEFT, nearness=lambda points: points[:, UP])
        if level:
            outline.ground(side)
        _goal_line(side, above, episode)
        side.set_title(f"{state.utime * 1e-6 - begin:.1f} s")
        side.set(xlim=(low[FORWARD], high[FORWARD]), ylim=(low[UP], high[UP]))
        above.set(xlabel="forward [m]", ylim=(low[LEFT], high[LEFT]))
    if from_left:
        axes[0, 0].invert_xaxis()  # both rows share it
        axes[1, 0].invert_yaxis()
    axes[0, 0].set_ylabel(f"from the {'left' if from_left else 'right'}:\nup [m]")
    axes[1, 0].set_ylabel("from above:\nleft [m]")
    _legend(figure, [shade for _, shade in poses[-1]])
    uneven = "" if level else "; the ground, which is not level, is not drawn"
    figure.suptitle(f"Motion of the robot in episode {episode.episode}{uneven}")
    return figure


def _parts(robot, episode, state):
    """[(part with its corners in the episode's frame, its colour)]"""
    failed = {name for name, health in zip(robot.actuators, state.actuator_health, strict=False) if health != 0}
    parts = []
    for part in robot.posed(state.position, state.orientation, state.actuator_position):
        seen = style.episode_frame(part.points, episode.start, episode.line_heading)
        part.points = np.column_stack([seen[:, 1], -seen[:, 0], seen[:, 2]])
        parts.append((part, outline.colour(robot, part, failed)))
    return parts


def _failed_side(parts):
    """How far to the left the failed crawler lies [m]; 0 where none has failed."""
    return next((part.points[:, LEFT].mean() for part, shade in parts if shade == style.RED and part.body == 0), 0.0)


def _goal_line(side, above, episode):
    for axes in (side, above):
        axes.axvline(episode.goal_distance, color=style.GREEN, linestyle="--", linewidth=1.4, zorder=2)


def _legend(figure, shades):
    handles = outline.handles(shades)
    handles.append(plt.Line2D([], [], color=style.GREEN, linestyle="--", label="goal line"))
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
