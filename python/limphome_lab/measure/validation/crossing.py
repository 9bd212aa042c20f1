"""A crawler over a step or a gap, slowly and seen from the side: balance at every stage of the way.

Ends are circles, the run between them is straight; edges of the ground are rounded. At each stage two places carry, and
the belts pull on both with the same share k of the load, at most the friction: what is missing follows from the three
equations of balance."""

import math
from dataclasses import dataclass

import numpy as np

from limphome_lab.measure.validation.bisection import limit

EDGE_RADIUS = 0.03  # of the simulator's steps [m]


@dataclass
class Profile:
    """Of the robot from the side: the middle of its rear circle is the origin, x ahead along the run."""

    radius: float
    run: float
    centre: np.ndarray  # of mass

    @classmethod
    def of(cls, machine):
        crawler = machine.crawlers[0]
        run = crawler.length - 2 * crawler.radius
        centre = machine.centre_of_mass(machine.frames(machine.home))
        rear = crawler.centre - [run / 2, 0, 0]
        return cls(crawler.radius, run, (centre - rear)[[0, 2]])


@dataclass
class Support:
    point: np.ndarray
    normal: np.ndarray  # into the robot

    def force(self, k):
        """Per unit of load, with the belt pulling ahead."""
        return self.normal + k * np.array([self.normal[1], -self.normal[0]])


def _cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def _goes_on(rear, front, centre, friction):
    """Whether some pull that friction allows balances the robot or moves it ahead."""
    arm = centre[0] - rear.point[0]
    for k in np.linspace(0, friction, 21):
        # moments about the rear support, then the vertical; forces over the weight
        lever = _cross(front.point - rear.point, front.force(k))
        on_front = arm / lever
        on_rear = (1 - on_front * front.force(k)[1]) / rear.force(k)[1]
        if lever > 0 and on_front * front.force(k)[0] + on_rear * rear.force(k)[0] >= 0:
            return True
    return False


def _turned(pitch, vector):
    c, s = math.cos(pitch), math.sin(pitch)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])


def _at_step(profile, corner, edge, pitch):
    """Middle of the rear circle, and the support at the step: by the front circle on the riser or on the rounded edge,
    or by the run on the edge. The riser is at 0."""
    along, up = _turned(pitch, (1, 0)), _turned(pitch, (0, 1))
    reach = profile.radius + edge
    above = profile.radius + profile.run * along[1] - corner[1]  # the middle of the front circle
    if above <= 0:
        front = np.array([-profile.radius, corner[1] + above])
        return front - profile.run * along, Support(front + [profile.radius, 0], np.array([-1.0, 0.0]))
    normal = np.array([-math.sqrt(max(0.0, reach**2 - above**2)), above]) / reach
    if above < reach and math.acos(above / reach) > pitch:
        return corner + reach * normal - profile.run * along, Support(corner + edge * normal, normal)
    from_rear = (corner[1] + reach * up[1] - profile.radius) / along[1]
    return corner + reach * up - from_rear * along, Support(corner + edge * up, up)


def gets_onto(profile, height, friction):
    """A step, through all stages from its front end at the edge until the weight is over it."""
    edge = min(EDGE_RADIUS, height)
    corner = np.array([edge, height - edge])  # middle of the rounding
    for pitch in np.arange(0, math.pi / 2, 5e-3):
        middle, step = _at_step(profile, corner, edge, pitch)
        rear = Support(middle - [0, profile.radius], np.array([0.0, 1.0]))
        centre = middle + _turned(pitch, profile.centre)
        if centre[0] >= step.point[0]:
            return True
        falls_back = centre[0] <= rear.point[0]
        if falls_back or not _goes_on(rear, step, centre, friction):
            return False
    return False


def widest_gap(profile):
    """Of a deep one: as its rear circle rolls off the near edge the robot leans back; its weight must be over the far
    edge before it has rolled off. (The front end sinks in, too, but the belts pull it out.)"""
    reach = profile.radius + EDGE_RADIUS
    near = np.array([-EDGE_RADIUS, -EDGE_RADIUS])  # middle of its rounding; the gap begins at 0

    def gets_over(width, off):
        rear = near + [off, math.sqrt(reach**2 - off**2)]
        to_far = np.array([width + EDGE_RADIUS, -EDGE_RADIUS]) - rear
        distance = np.linalg.norm(to_far)
        if distance <= reach:
            return True
        pitch = math.atan2(to_far[1], to_far[0]) + math.asin(reach / distance)  # its run lies on the far edge
        ahead = _turned(pitch, profile.centre)[0] - (to_far[0] - EDGE_RADIUS * math.sin(pitch))
        return ahead >= 0

    offs = np.linspace(0, reach, 200, endpoint=False)
    return limit(lambda width: any(gets_over(width, off) for off in offs), 0.1 * profile.run, 2 * profile.run, 1e-4)
