"""What a robot without inertia does, from the numbers of its file alone: loads by the lever rule, motion by the least
power lost to friction. Nothing here knows the simulator."""

from dataclasses import dataclass

import numpy as np

from limphome_lab import robot

GRAVITY = 9.81  # [m/s^2]
LEVEL, ORIGIN = np.eye(3), np.zeros(3)  # a robot's axes and position as it starts, but for the heading


@dataclass
class Crawler:
    centre: np.ndarray
    length: float
    width: float
    radius: float


class Machine:
    """Masses and points of contact of the robot in a file."""

    def __init__(self, path):
        self.robot = robot.read(path)
        self.mass = sum(body["mass"] for body in self.robot.bodies)
        self.weight = self.mass * GRAVITY
        self.crawlers = [
            Crawler(np.array(c["centre"]), c["length"], c["width"], c["radius"]) for c in self.robot.told["crawlers"]
        ]
        self.home = self.robot.home
        self.arm_home = self.home[len(self.crawlers) :]
        tip = self.robot.tips[0]
        self.tip = (tip["body"], np.array(tip["point"]), tip["radius"])
        sprocket = self.robot.bodies[1 + self.robot.crawlers.index("right_crawler")]
        self.sprocket_inertia = np.array(sprocket["axis"]) @ sprocket["inertia"] @ sprocket["axis"]

    def all_rates(self, rates):
        """`rates` of the first actuators, and 0 for the others: (of the crawlers, of the arm)."""
        rates = [*rates, *(0.0 for _ in range(len(self.home) - len(rates)))]
        return rates[: len(self.crawlers)], rates[len(self.crawlers) :]

    def frames(self, angles, position=(0, 0, 0), orientation=(1, 0, 0, 0)):
        return self.robot.frames(angles, position, orientation)

    def centre_of_mass(self, frames):
        bodies = zip(frames, self.robot.bodies, strict=True)
        return sum(body["mass"] * robot.apply(frame, body["centre"]) for frame, body in bodies) / self.mass

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
        body, centre, radius = self.tip
        return robot.apply(frames[body], centre) - [0, 0, radius]


def loads(points, centre_of_mass, weight):
    """Forces on equal springs under a stiff body: linear over the ground plane. Three points are the lever rule."""
    basis = np.column_stack([np.ones(len(points)), points[:, 0], points[:, 1]])
    moments = weight * np.array([1, centre_of_mass[0], centre_of_mass[1]])
    return basis @ np.linalg.solve(basis.T @ basis, moments)


def yaw_per_swing(machine, angles):
    """Turn of the base per turn of the first arm joint, about the vertical, with nothing to hold it: their angular
    momenta about the common centre of mass cancel."""
    bodies = machine.robot.bodies
    first = 1 + len(machine.crawlers)  # the body that the first arm joint moves
    frames = machine.frames(angles)
    common, pivot = machine.centre_of_mass(frames)[:2], frames[first][:2, 3]
    carried = {first}
    for index, body in enumerate(bodies):  # each after its parent
        if body["parent"] in carried:
            carried.add(index)
    whole = swinging = 0.0
    for index, body in enumerate(bodies):
        axes, mass = frames[index][:3, :3], body["mass"]
        place = robot.apply(frames[index], np.array(body["centre"]))[:2]
        own = (axes @ np.array(body["inertia"]) @ axes.T)[2, 2]
        whole += own + mass * np.sum((place - common) ** 2)
        if index in carried:
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
