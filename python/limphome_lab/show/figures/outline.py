"""Outlines of the robot's parts, seen from the side or from above."""

import numpy as np
from matplotlib.patches import Polygon

from limphome_lab.show.figures import style

FORWARD, LEFT, UP = 0, 1, 2  # columns of points
CRAWLER = "#3d454d"
CHASSIS = "#6b7784"
UPPER_BODY = "#b9c4cf"
ARM = style.ORANGE
LABELS = {
    style.RED: "failed",
    CRAWLER: "crawler",
    CHASSIS: "chassis",
    UPPER_BODY: "upper body",
    ARM: "boom and arm",
}


def colour(robot, part, failed=()):
    """Of a part of the robot; that of an actuator that failed is red."""
    if part.name in robot.crawlers:
        return style.RED if part.name in failed else CRAWLER
    if part.body == 0:
        return CHASSIS
    if robot.actuators[part.body - 1] in failed:
        return style.RED
    return UPPER_BODY if robot.bodies[part.body]["parent"] == 0 else ARM


def view(axes, parts, across, nearness, alpha=1.0):
    """Outlines of all parts, [(part, its colour)], those nearest to the eye last."""
    axes.set_aspect("equal")
    for part, shade in sorted(parts, key=lambda each: nearness(each[0].points).mean()):
        axes.add_patch(
            Polygon(
                convex_hull(part.points[:, [FORWARD, across]]),
                closed=True,
                facecolor=shade,
                edgecolor="white",
                linewidth=0.8,
                alpha=alpha,
                zorder=3,
            )
        )


def ground(side):
    side.axhspan(-10, 0, color="#d9cfc1", zorder=1)
    side.axhline(0, color="#8a7a64", linewidth=1.2, zorder=2)


def handles(shades):
    """For a legend of those that are among `shades`."""
    return [Polygon([(0, 0)], facecolor=shade, label=label) for shade, label in LABELS.items() if shade in shades]


def convex_hull(points):
    """Corners of the convex hull of [n x 2] points, counter-clockwise (Andrew's monotone chain)."""
    points = sorted(map(tuple, points))

    def chain(ordered):
        hull = []
        for point in ordered:
            while len(hull) > 1 and _cross(hull[-2], hull[-1], point) <= 0:
                hull.pop()
            hull.append(point)
        return hull[:-1]

    return np.array(chain(points) + chain(reversed(points)))


def _cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
