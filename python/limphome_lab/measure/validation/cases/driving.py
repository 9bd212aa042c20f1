"""Both crawlers on level ground: straight on, and turns against the least power lost to friction."""

import math

import numpy as np

from limphome_lab.measure.instrument import CRAWLER, LEFT_FREE, LEFT_LOCKED, RIGHT, SOUND, Instrument
from limphome_lab.measure.validation import statics
from limphome_lab.measure.validation.cases.quantity import MU, SPEED, Quantity
from limphome_lab.measure.validation.robots import base_centre_at, changed_robot


def straight_drive():
    with Instrument(SOUND) as plant:
        plant.run(1, SPEED, SPEED)
        start = plant.report()
        plant.run(10, SPEED, SPEED)
        end = plant.report()
    moved = end.position - start.position
    yield Quantity("straight drive", "speed", "m/s", "belt speed", SPEED, moved[1] / 10, 1e-3 * SPEED)
    yield Quantity("straight drive", "sideways in 3 m", "mm", "none", 0, 1e3 * moved[0], 1)


def _turn(case, settings, speeds, machine, mu, robot=CRAWLER):
    """Turning rate and torque of the right drive against the least power lost to friction."""
    motion, pull = statics.least_power(statics.on_crawlers(machine, mu), speeds)
    commands = [speed or 0 for speed in speeds]
    with Instrument((*settings, f"simulator.friction_crawler={mu}"), robot) as plant:
        plant.run(3, *commands)
        rate, end = plant.turning_rate(3, *commands)
    torque = pull[RIGHT] * machine.crawlers[RIGHT].radius
    yield Quantity(case, "yaw rate", "rad/s", "least power", motion[2], rate, max(5e-3 * abs(motion[2]), 1e-6))
    yield Quantity(
        case,
        "torque of the right drive",
        "N m",
        "least power",
        torque,
        end.actuator_effort[RIGHT],
        max(5e-3 * abs(torque), 0.5),
    )


def locked_crawler():
    machine = statics.Machine(CRAWLER)
    for mu in (0.2, 0.7, 1.0):
        yield from _turn(f"left locked, friction {mu}", LEFT_LOCKED, (0, SPEED), machine, mu)
    for x, y in ((0.25, 0), (-0.25, 0), (0, 0.15)):
        with changed_robot(base_centre_at(x, y)) as robot:
            offset = statics.Machine(robot)
            centre = offset.centre_of_mass(offset.frames(offset.home))
            name = f"left locked, centre of mass at ({centre[0]:.2f}, {centre[1]:.2f}) m"
            yield from _turn(name, LEFT_LOCKED, (0, SPEED), offset, MU, robot)


def free_crawler():
    yield from _turn("left free", LEFT_FREE, (None, SPEED), statics.Machine(CRAWLER), MU)


def counter_rotation():
    yield from _turn("counter-rotation", SOUND, (-SPEED, SPEED), statics.Machine(CRAWLER), MU)


def turning_radius():
    """Of the circle on which the middle between the crawlers goes, slowly, as statics knows no inertia; rolling without
    skidding it would be track width / 2 * (right + left) / (right - left)."""
    right = 0.1
    machine = statics.Machine(CRAWLER)
    footing = statics.on_crawlers(machine, MU)
    for ratio in (0.9, 0.75, 0.5, 0.25, 0, -0.5):
        speeds = (ratio * right, right)
        motion, _ = statics.least_power(footing, speeds)
        radius = np.hypot(motion[0], motion[1]) / motion[2]
        with Instrument(SOUND) as plant:
            plant.run(5, *speeds)
            start = plant.report()
            rate, end = plant.turning_rate(4, *speeds)
        chord = np.linalg.norm((end.position - start.position)[:2])
        measured = 0.5 * chord / math.sin(0.5 * rate * (end.time - start.time))
        case = f"turn, left belt at {ratio:g} of the right"
        yield Quantity(case, "radius", "m", "least power", radius, measured, 5e-3 * radius)
        yield Quantity(case, "yaw rate", "rad/s", "least power", motion[2], rate, 5e-3 * motion[2])
