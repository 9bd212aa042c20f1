"""What a robot without inertia does, from the numbers of its URDF alone: loads by the lever rule, motion by the least
power lost to friction. Nothing here knows the simulator."""

import xml.etree.ElementTree as xml
from dataclasses import dataclass

import numpy as np

from limphome_lab import urdf

GRAVITY = 9.81  # [m/s^2]
LEVEL, ORIGIN = np.eye(3), np.zeros(3)  # a robot's axes and position as it starts, but for the heading


@dataclass
class Crawler:
    centre: np.ndarray
    length: float
    width: float
    radius: float


class Machine:
    """Masses and points of contact of the robot in a URDF file."""

    def __init__(self, path):
        root = xml.parse(path).getroot()
        self.robot = urdf.Robot(path)
        self.inertials = {link.get("name"): self._inertial(link) for link in root.findall("link")}
        self.inertia = {link.get("name"): self._inertia(link) for link in root.findall("link")}
        self.mass = sum(mass for mass, _ in self.inertials.values())
        self.weight = self.mass * GRAVITY
        extension = root.find("limphome")
        self.crawlers = [
            Crawler(_numbers(e.get("xyz")), *(float(e.get(k)) for k in ("length", "width", "radius")))
            for e in extension.findall("crawler")
        ]
        self.arm_home = np.array([float(e.get("home")) for e in extension.findall("arm")])
        self.home = np.concatenate([np.zeros(len(self.crawlers)), self.arm_home])
        tip = extension.find("tip")
        self.tip = (tip.get("link"), _numbers(tip.get("xyz")), float(tip.get("radius")))
        sprocket = root.find("link[@name='right_sprocket']/inertial/inertia")
        self.sprocket_inertia = float(sprocket.get("iyy"))

    @staticmethod
    def _inertial(link):
        inertial = link.find("inertial")
        origin = inertial.find("origin")
        centre = np.zeros(3) if origin is None else _numbers(origin.get("xyz"))
        return float(inertial.find("mass").get("value")), centre

    @staticmethod
    def _inertia(link):
        """[3x3] about the link's centre of mass [kg m^2]."""
        e = link.find("inertial/inertia")
        xx, yy, zz, xy, xz, yz = (float(e.get(k)) for k in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"))
        return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])

    def all_rates(self, rates):
        """`rates` of the first actuators, and 0 for the others: (of the crawlers, of the arm)."""
        rates = [*rates, *(0.0 for _ in range(len(self.home) - len(rates)))]
        return rates[: len(self.crawlers)], rates[len(self.crawlers) :]

    def frames(self, angles, position=(0, 0, 0), orientation=(1, 0, 0, 0)):
        return self.robot.link_frames(position, orientation, dict(zip(self.robot.actuators, angles, strict=True)))

    def centre_of_mass(self, frames):
        moment = sum(mass * _point(frames[link], centre) for link, (mass, centre) in self.inertials.items())
        return moment / self.mass

    def crawler_points(self, crawler, axes=LEVEL, position=ORIGIN, sides=(0.5, -0.5)):
        """Lowest points of the edges round both ends of a belt, for a robot in this pose; sides as multiples of the
        width."""
        c = self.crawlers[crawler]
        up = axes.T @ [0, 0, 1]  # in the body frame
        down = -np.array([up[0], 0, up[2]]) / np.hypot(up[0], up[2])
        points = [
            c.centre + [end * (c.length - 2 * c.radius), side * c.width, 0] + c.radius * down
            for end in (0.5, -0.5)
            for side in sides
        ]
        return np.array(points) @ axes.T + position

    def tip_point(self, frames):
        link, centre, radius = self.tip
        return _point(frames[link], centre) - [0, 0, radius]


def loads(points, centre_of_mass, weight):
    """Forces on equal springs under a stiff body: linear over the ground plane. Three points are the lever rule."""
    basis = np.column_stack([np.ones(len(points)), points[:, 0], points[:, 1]])
    moments = weight * np.array([1, centre_of_mass[0], centre_of_mass[1]])
    return basis @ np.linalg.solve(basis.T @ basis, moments)


def yaw_per_swing(machine, angles):
    """Turn of the base per turn of the first arm joint, about the vertical, with nothing to hold it: their angular
    momenta about the common centre of mass cancel."""
    swing = next(joint for joint in machine.robot.joints if joint.name == machine.robot.arm[0])
    frames = machine.frames(angles)
    common, pivot = machine.centre_of_mass(frames)[:2], frames[swing.child][:2, 3]
    carried = {swing.child}
    for joint in machine.robot.joints:  # parents come before their children in the file
        if joint.parent in carried:
            carried.add(joint.child)
    whole = swinging = 0.0
    for link, (mass, centre) in machine.inertials.items():
        axes, place = frames[link][:3, :3], _point(frames[link], centre)[:2]
        own = (axes @ machine.inertia[link] @ axes.T)[2, 2]
        whole += own + mass * np.sum((place - common) ** 2)
        if link in carried:
            swinging += own + mass * (place - common) @ (place - pivot)
    return -swinging / whole


def holding_torques(machine, pose, tip_load):
    """Of the arm's drives [N m]: what a small turn of each joint lifts of the weight, less what the ground lifts at the
    tip. `pose` has actuator_position, position and orientation."""

    def energy(angles):
        frames = machine.frames(angles, pose.position, pose.orientation)
        return machine.weight * machine.centre_of_mass(frames)[2] - tip_load * machine.tip_point(frames)[2]

    small = 1e-5
    turns = small * np.eye(len(machine.home))[len(machine.crawlers) :]
    angles = pose.actuator_position
    return np.array([energy(angles + turn) - energy(angles - turn) for turn in turns]) / (2 * small)


@dataclass
class Footing:
    """Points of contact in the body frame with the friction they can bear and the belt they belong to."""

    points: np.ndarray
    friction: np.ndarray  # mu N [N]
    belt: np.ndarray  # index of the belt, -1: none


def on_crawlers(machine, mu, angles=None, gravity=(0, 0, -GRAVITY)):
    """The robot on both crawlers; `gravity` in its frame, with sideways components where the ground slopes."""
    points = np.vstack([machine.crawler_points(crawler) for crawler in (0, 1)])
    frames = machine.frames(machine.home if angles is None else angles)
    down = np.array(gravity) / -gravity[2]
    centre = machine.centre_of_mass(frames)
    carried = loads(points, centre + centre[2] * down, -machine.mass * gravity[2])  # as if it stood over where it leans
    return Footing(points, mu * carried, np.repeat([0, 1], 4))


def least_power(footing, belt_speeds, push=(0, 0, 0)):
    """Motion (vx, vy, yaw rate) that loses least power sum mu N |slip|, with the force that the ground takes from each
    belt [N]. A belt whose speed is None turns freely and is found too. `push` (forces ahead and to the left [N], moment
    about the origin [N m]) gives power. The sum is convex; Newton's method on it with |slip| rounded off more and more
    finely."""
    free = [b for b, speed in enumerate(belt_speeds) if speed is None]
    n = len(footing.points)
    slip = np.zeros((n, 2, 3 + len(free)))  # slip velocity = slip @ unknowns - known
    slip[:, 0, 0] = slip[:, 1, 1] = 1
    slip[:, 0, 2], slip[:, 1, 2] = -footing.points[:, 1], footing.points[:, 0]
    known = np.zeros((n, 2))
    for i, belt in enumerate(footing.belt):
        if belt in free:
            slip[i, 0, 3 + free.index(belt)] = -1
        elif belt >= 0:
            known[i, 0] = belt_speeds[belt]
    unknowns = np.zeros(3 + len(free))
    given = np.concatenate([push, np.zeros(len(free))])
    for rounding in 10.0 ** np.arange(-1, -8, -0.5):
        unknowns = _newton(unknowns, slip, known, footing.friction, given, rounding)
    velocity = slip @ unknowns - known
    force = footing.friction[:, None] * velocity / np.hypot(np.linalg.norm(velocity, axis=1), rounding)[:, None]
    pull = np.array([force[footing.belt == belt, 0].sum() for belt in range(len(belt_speeds))])
    return unknowns[:3], -pull


def _newton(unknowns, slip, known, friction, given, rounding):
    def power(x):
        return np.sum(friction * np.sqrt(np.sum((slip @ x - known) ** 2, axis=1) + rounding**2)) - given @ x

    for _ in range(200):
        velocity = slip @ unknowns - known
        length = np.sqrt(np.sum(velocity**2, axis=1) + rounding**2)
        direction = velocity / length[:, None]
        gradient = np.einsum("i,ij,ijk->k", friction, direction, slip) - given
        bend = (np.eye(2) - direction[:, :, None] * direction[:, None, :]) * (friction / length)[:, None, None]
        step = -np.linalg.lstsq(np.einsum("ijk,ijl,ilm->km", slip, bend, slip), gradient, rcond=1e-14)[0]
        size = 1.0
        while power(unknowns + size * step) > power(unknowns) and size > 1e-12:
            size /= 2
        unknowns = unknowns + size * step
        if np.abs(size * step).max() < 1e-13:
            break
    return unknowns


def _numbers(text):
    return np.array([float(word) for word in text.split()])


def _point(frame, local):
    return frame[:3, :3] @ local + frame[:3, 3]
