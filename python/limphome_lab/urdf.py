"""The robot's shape from its URDF, posed by a robot_state_t: for pictures only, so boxes and crawlers are all it knows.

Frames and actuator order as in lcmtypes/limphome_robot_state.lcm.
"""

import xml.etree.ElementTree as xml
from dataclasses import dataclass

import numpy as np

CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
END_POINTS = 13  # points on each rounded end of a crawler; odd, so that its very end is one


@dataclass
class Joint:
    name: str
    parent: str
    child: str
    origin: np.ndarray  # [4x4] child's frame in the parent's at angle 0
    axis: np.ndarray  # [3] unit, in the child's frame


@dataclass
class Part:
    """A convex piece of the robot."""

    name: str  # of the link, or of the crawler's joint
    points: np.ndarray  # [n x 3] its corners in `link`'s frame, or in the world's once posed
    link: str


class Robot:
    def __init__(self, path):
        root = xml.parse(path).getroot()
        self.joints = [_joint(element) for element in root.findall("joint")]
        extension = root.find("limphome")
        self.crawlers = [element.get("joint") for element in extension.findall("crawler")]
        self.arm = [element.get("joint") for element in extension.findall("arm")]
        self.actuators = self.crawlers + self.arm
        parents = {joint.name: joint.parent for joint in self.joints}
        self.base = next(iter({joint.parent for joint in self.joints} - {joint.child for joint in self.joints}))
        self.parts = [part for link in root.findall("link") for part in _boxes(link)]
        self.parts += [_crawler(element, parents[element.get("joint")]) for element in extension.findall("crawler")]

    def posed(self, position, orientation, angles):
        """Parts with their corners in the world; `angles` per actuator (what a message has beyond is left out),
        `orientation` (w, x, y, z) body to world."""
        frames = self.link_frames(position, orientation, dict(zip(self.actuators, angles, strict=False)))
        return [Part(part.name, _apply(frames[part.link], part.points), part.link) for part in self.parts]

    def link_frames(self, position, orientation, angle_of):
        """[4x4] frame of each link in the world. Crawlers' sprockets are left unturned: nothing is seen of them."""
        frames = {self.base: _frame(rotation_of(orientation), position)}
        waiting = list(self.joints)
        while waiting:
            ready = [joint for joint in waiting if joint.parent in frames]
            if not ready:
                raise ValueError(f"joint {waiting[0].name} hangs on no link that hangs on {self.base}")
            for joint in ready:
                angle = angle_of.get(joint.name, 0.0) if joint.name in self.arm else 0.0
                turn = _frame(rotation_about(joint.axis, angle), np.zeros(3))
                frames[joint.child] = frames[joint.parent] @ joint.origin @ turn
                waiting.remove(joint)
        return frames


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
    """[3x3] rotation by `angle` about the unit vector `axis`."""
    return rotation_of(np.concatenate(([np.cos(angle / 2)], np.sin(angle / 2) * np.asarray(axis))))


def _frame(rotation, position):
    frame = np.eye(4)
    frame[:3, :3] = rotation
    frame[:3, 3] = position
    return frame


def _apply(frame, points):
    return points @ frame[:3, :3].T + frame[:3, 3]


def _numbers(text):
    return np.array([float(word) for word in text.split()])


def _origin(element):
    """[4x4] of an <origin> below `element`; URDF applies roll, pitch, yaw about fixed axes in this order."""
    origin = element.find("origin")
    if origin is None:
        return np.eye(4)
    roll, pitch, yaw = _numbers(origin.get("rpy", "0 0 0"))
    rotation = rotation_about([0, 0, 1], yaw) @ rotation_about([0, 1, 0], pitch) @ rotation_about([1, 0, 0], roll)
    return _frame(rotation, _numbers(origin.get("xyz", "0 0 0")))


def _joint(element):
    axis = element.find("axis")
    axis = np.array([1.0, 0.0, 0.0]) if axis is None else _numbers(axis.get("xyz"))
    return Joint(
        element.get("name"),
        element.find("parent").get("link"),
        element.find("child").get("link"),
        _origin(element),
        axis / np.linalg.norm(axis),
    )


def _boxes(link):
    for visual in link.findall("visual"):
        box = visual.find("geometry/box")
        if box is not None:
            yield Part(link.get("name"), _apply(_origin(visual), CORNERS * _numbers(box.get("size"))), link.get("name"))


def _crawler(element, link):
    """A belt round two ends of `radius`, `length` over all."""
    length, width, radius = (float(element.get(name)) for name in ("length", "width", "radius"))
    around = np.linspace(-np.pi / 2, np.pi / 2, END_POINTS)
    end = np.column_stack([length / 2 - radius + radius * np.cos(around), radius * np.sin(around)])
    outline = np.vstack([end, -end])
    points = [[x, y, z] for x, z in outline for y in (-width / 2, width / 2)]
    return Part(element.get("joint"), np.array(points) + _numbers(element.get("xyz")), link)
