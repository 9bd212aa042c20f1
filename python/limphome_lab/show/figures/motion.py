"""Fig. 9: how the robot moves in one episode, at a few times, seen from the side and from above.

The frame is that of the episode: forward is along its straight line from the start, left is across it. The side view is
from the side of the failed crawler; from the left, forward points to the left. Only level ground is drawn: any other
lies elsewhere under each part of the robot.
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Polygon

from limphome_lab.robot import apply, read
from limphome_lab.show.figures import outline, style
from limphome_lab.show.figures.outline import FORWARD, LEFT, UP

AT = (0.13, 0.44, 0.76, 1.0)  # of the episode: the paper's 2.0, 7.0, 12.0 and 15.8 s
# corners of the mark from the front of a robot of the paper's size: a triangle that is seen from above and aside [m]
FRONT = np.array([[0.08, 0.15, 0.18], [0.08, -0.15, 0.18], [0.08, 0, 0.42], [0.3, 0, 0.3]])


def draw(file, episode, states, level=True):
    """`level`: whether the ground is."""
    robot = read(file)
    chosen = [states[i] for i in np.unique((np.array(AT) * (len(states) - 1)).round().astype(int))]
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
        _front(side, above, robot, episode, state)
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


def _in_episode(points, episode):
    """World points [n x 3] in the episode's frame: forward, left, up."""
    seen = style.episode_frame(points, episode.start, episode.line_heading)
    return np.column_stack([seen[:, 1], -seen[:, 0], seen[:, 2]])


def _front(side, above, robot, episode, state):
    """A mark ahead of the robot, as front and back of a crawler look alike."""
    ahead = max(part.points[:, 0].max() for part in robot.parts if part.body == 0)
    size = robot.told["crawlers"][0]["length"] / 1.6
    body = robot.frames(robot.home, state.position, state.orientation)[0]
    mark = apply(body, size * FRONT + [ahead, 0, 0])
    seen = _in_episode(mark, episode)
    for axes, across in ((side, UP), (above, LEFT)):
        axes.add_patch(Polygon(outline.convex_hull(seen[:, [FORWARD, across]]), color=style.INK, linewidth=0, zorder=4))


def _parts(robot, episode, state):
    """[(part with its corners in the episode's frame, its colour)]"""
    failed = {name for name, health in zip(robot.actuators, state.actuator_health, strict=False) if health != 0}
    parts = []
    for part in robot.posed(state.position, state.orientation, state.actuator_position):
        part.points = _in_episode(part.points, episode)
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
    handles.append(plt.Line2D([], [], color=style.INK, marker="^", linestyle="", label="front"))
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
