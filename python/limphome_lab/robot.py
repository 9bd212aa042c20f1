"""The robot as both programs understand its file: what limphome-describe tells, posed by joint angles.

Frames and actuator order as in lcmtypes/limphome_robot_state.lcm; the fields of the description are those of
robot/robot_description.h and controller/describe/facts.h.
"""

from dataclasses import dataclass

import numpy as np

from limphome_lab import describe
from limphome_lab.ending import InputError

END_POINTS = 13  # points on each rounded end of a crawler; odd, so that its very end is one
AROUND = np.linspace(0, 2 * np.pi, 24, endpoint=False)  # points round a cylinder or ball [rad]
CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])


@dataclass
class Part:
    """A convex piece of the robot."""

    name: str  # of the link, or of the crawler's joint
    points: np.ndarray  # [n x 3] its corners in the frame of `body`, or in the world's once posed
    body: int


def read(file, packages=None):
    """The robot in a file. What is refused ends with the reasons."""
    code, told = describe.ask(file, packages)
    if code != 0:
        raise InputError("\n".join(told["faults"]))
    return Robot(told)


class Robot:
    def __init__(self, told):
        self.told = told
        self.bodies = told["bodies"]
        self.actuators = [actuator["name"] for actuator in told["actuators"]]
        self.crawlers = [actuator["name"] for actuator in told["actuators"] if actuator["crawler"]]
        self.arm = self.actuators[len(self.crawlers) :]
        self.home = np.array([actuator["home"] for actuator in told["actuators"]])
        self.tips = [support for support in told["supports"] if support["tip"]]
        self.parts = [_shape(shape) for shape in told["shapes"]]
        self.parts += [Part(name, belt(c), 0) for name, c in zip(self.crawlers, told["crawlers"], strict=True)]

    def posed(self, position, orientation, angles):
        """Parts with their corners in the world; `angles` per actuator (what a message has beyond is left out),
        `orientation` (w, x, y, z) body to world."""
        frames = self.frames(angles, position, orientation)
        return [Part(part.name, apply(frames[part.body], part.points), part.body) for part in self.parts]

    def frames(self, angles, position=(0, 0, 0), orientation=(1, 0, 0, 0)):
        """[... x 4 x 4] frame of each body in the world, for angles [... x actuators]. Crawlers' sprockets are left
        unturned: nothing is seen of them."""
        angles = np.asarray(angles, dtype=float)
        frames = [np.broadcast_to(_frame(rotation_of(orientation), position), (*angles.shape[:-1], 4, 4))]
        for index, body in enumerate(self.bodies[1:]):
            frame = frames[body["parent"]] @ _frame(rotation_of(body["rotation"]), body["position"])
            if index >= len(self.crawlers):
                turn = np.zeros_like(frame)
                turn[..., :3, :3] = rotation_about(body["axis"], angles[..., index])
                turn[..., 3, 3] = 1
                frame = frame @ turn
            frames.append(frame)
        return frames


def belt(crawler):
    """[n x 3] corners of a belt round two ends of its radius, in the frame of the base."""
    length, width, radius = (crawler[name] for name in ("length", "width", "radius"))
    around = np.linspace(-np.pi / 2, np.pi / 2, END_POINTS)
    end = np.column_stack([length / 2 - radius + radius * np.cos(around), radius * np.sin(around)])
    across = np.array(crawler["axis"])
    up = np.array([0, 0, 1])
    forward = np.cross(across, up) / np.linalg.norm(np.cross(across, up))
    outline = [x * forward + z * np.cross(forward, across) for x, z in np.vstack([end, -end])]
    return (
        np.array([point + side * across for point in outline for side in (-width / 2, width / 2)]) + crawler["centre"]
    )


def rotation_of(quaternion):
    """[3x3] matrix of a unit quaternion (w, x, y, z)."""
    w, x, y, z = np.asarray(quaternion) / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def rotation_about(axis, angle):
    """[... x 3 x 3] rotations by `angle` [...] about the unit vector `axis`."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.asarray(angle, dtype=float)[..., None, None]
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * (cross @ cross)


def apply(frame, points):
    """Points [3] or [n x 3] of a [4x4] frame in the frame around it."""
    return np.asarray(points) @ np.swapaxes(frame[..., :3, :3], -1, -2) + frame[..., :3, 3]


def _frame(rotation, position):
    frame = np.eye(4)
    frame[:3, :3] = rotation
    frame[:3, 3] = position
    return frame


def _shape(shape):
    x, y, z = shape["half_size"]
    if shape["kind"] == "box":
        corners = CORNERS * (x, y, z)
    elif shape["kind"] == "cylinder":
        rim = np.column_stack([x * np.cos(AROUND), y * np.sin(AROUND), np.full(len(AROUND), z)])
        corners = np.vstack([rim, rim * (1, 1, -1)])
    else:
        rings = [
            np.column_stack([np.cos(AROUND) * c, np.sin(AROUND) * c, np.full(len(AROUND), s)])
            for c, s in zip(np.cos(AROUND), np.sin(AROUND), strict=True)
        ]
        corners = x * np.vstack(rings)
    frame = _frame(rotation_of(shape["rotation"]), shape["position"])
    return Part(shape["name"], apply(frame, corners), shape["body"])
