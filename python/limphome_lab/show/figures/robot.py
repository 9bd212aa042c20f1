"""The robot as its file describes it, in its initial pose: from the right side and from above."""

import matplotlib.pyplot as plt
import numpy as np

from limphome_lab.robot import apply
from limphome_lab.show.figures import outline, style
from limphome_lab.show.figures.outline import FORWARD, LEFT, UP

POSTURES = 60_000  # of the arm, tried at random for where the tips come to
CELLS = 60  # along each side of that area
WIDTH = 7  # of the figure [in]
CENTRE_OF_MASS = {
    "marker": "o",
    "linestyle": "",
    "markersize": 9,
    "color": "white",
    "markeredgecolor": style.RED,
    "markeredgewidth": 2.5,
}


def draw(robot):
    frames = robot.frames(robot.home)
    parts = [(part, outline.colour(robot, part)) for part in robot.posed((0, 0, 0), (1, 0, 0, 0), robot.home)]
    reached = _reached(robot)
    points = np.vstack([*(part.points for part, _ in parts), reached])
    low, high = points.min(axis=0), points.max(axis=0)
    pad = 0.06 * (high - low).max()
    low, high = low - pad, high + pad
    span = high - low
    heights = [WIDTH * span[across] / span[FORWARD] for across in (UP, LEFT)]
    figure, (side, above) = plt.subplots(
        2, 1, figsize=(WIDTH + 0.8, sum(heights) + 1.8), height_ratios=heights, sharex=True, layout="constrained"
    )
    for axes, across in ((side, UP), (above, LEFT)):
        _reach(axes, reached, across)
        nearest_last = -1 if across == UP else 1  # seen from the right, or from above
        outline.view(
            axes, parts, across, lambda p, a=across, s=nearest_last: s * p[:, LEFT if a == UP else UP], alpha=0.75
        )
        axes.plot(*np.array(robot.told["home"]["centre_of_mass"])[[FORWARD, across]], **CENTRE_OF_MASS, zorder=6)
        axes.set(xlim=(low[FORWARD], high[FORWARD]), ylim=(low[across], high[across]))
        _joints(axes, robot, frames, across)
    outline.ground(side)
    side.set_ylabel("from the right:\nup [m]")
    above.set(xlabel="forward [m]", ylabel="from above:\nleft [m]")
    _supports(above, robot, frames)
    _legend(figure, {shade for _, shade in parts})
    figure.suptitle(f"{robot.told['name']}, {robot.told['mass']:.4g} kg, in its initial pose")
    return figure


def _reached(robot):
    """[n x 3] points where the middle of a tip comes to over the ranges of all joints, the body level."""
    actuators = robot.told["actuators"]
    low, high = ([a[key] * (not a["crawler"]) for a in actuators] for key in ("lower", "upper"))
    frames = robot.frames(np.random.default_rng(1).uniform(low, high, (POSTURES, len(actuators))))
    return np.vstack([apply(frames[tip["body"]], tip["point"]) for tip in robot.tips])


def _reach(axes, reached, across):
    """The area in which the tips come to."""
    counts, *edges = np.histogram2d(*reached[:, [FORWARD, across]].T, bins=CELLS)
    x, y = ((edge[1:] + edge[:-1]) / 2 for edge in edges)
    axes.contourf(x, y, (counts > 0).T.astype(float), levels=[0.5, 1.5], colors=[style.GREEN], alpha=0.18, zorder=2.5)


def _joints(axes, robot, frames, across):
    """Joints of the arm by name, and lines to what they hang on: an arm need not have shapes."""
    seen = [frame[[FORWARD, across], 3] for frame in frames]
    near = 0.03 * np.ptp(axes.get_xlim())  # names nearer than this would lie on one another
    names = {}
    for body in range(1 + len(robot.crawlers), len(frames)):
        parent = robot.bodies[body]["parent"]
        if parent > 0:
            axes.plot(*zip(seen[parent], seen[body], strict=True), color=style.INK, linewidth=1, zorder=4)
        axes.plot(*seen[body], "o", markersize=4, color=style.INK, zorder=5)
        names.setdefault(tuple((seen[body] / near).round()), (seen[body], []))[1].append(robot.actuators[body - 1])
    for tip in robot.tips:
        at = apply(frames[tip["body"]], tip["point"])[[FORWARD, across]]
        axes.plot(*zip(seen[tip["body"]], at, strict=True), color=style.INK, linewidth=1, zorder=4)
    for at, joints in names.values():
        axes.annotate(", ".join(joints), at, (4, 4), textcoords="offset points", fontsize=8, zorder=7)


def _supports(above, robot, frames):
    """What it stands on with its arm in the air, and the tips."""
    for support in robot.told["supports"]:
        at = apply(frames[support["body"]], support["point"])[[FORWARD, LEFT]]
        above.plot(*at, "x", color=style.BLUE, zorder=6)
    base = [s["point"][:2] for s in robot.told["supports"] if s["body"] == 0]
    if len(base) > 2:
        corners = outline.convex_hull(base)
        above.plot(*np.vstack([corners, corners[:1]]).T, "--", color=style.BLUE, linewidth=1.4, zorder=5)


def _legend(figure, shades):
    marks = [
        plt.Line2D([], [], **CENTRE_OF_MASS, label="centre of mass"),
        plt.Line2D([], [], marker="x", linestyle="--", color=style.BLUE, label="supports"),
        outline.Polygon([(0, 0)], facecolor=style.GREEN, alpha=0.3, label="reach of the tip"),
    ]
    figure.legend(handles=[*outline.handles(shades), *marks], loc="outside lower center", ncols=4)
