"""The arm on the ground, by the lever rule."""

import math

import numpy as np

from limphome_lab.measure.instrument import CRAWLER, LEFT, RIGHT, Instrument
from limphome_lab.measure.validation import statics
from limphome_lab.measure.validation.cases.quantity import MU, QUARTER_TURN_S, SPEED, Quantity


def press_down(plant):
    """Turns the arm to the left and presses it down until the left side is off the ground."""
    plant.run(QUARTER_TURN_S, 0, 0, SPEED)
    plant.run(4, 0, 0, 0, -SPEED)
    plant.run(2)


def three_points(machine, report):
    """Points of a robot on its tip and the outer edge of the right crawler, and their loads by the lever rule."""
    frames = machine.frames(report.actuator_position, report.position, report.orientation)
    edge = machine.crawler_points(1, report.axes, report.position, sides=(-0.5,))
    points = np.vstack([machine.tip_point(frames), edge])
    return points, statics.loads(points, machine.centre_of_mass(frames), machine.weight)


def lifted_footing(machine, report):
    points, load = three_points(machine, report)
    cosine, sine = math.cos(report.heading), math.sin(report.heading)
    heading = np.array([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]])
    return statics.Footing((points - report.position) @ heading, MU * load, np.array([-1, RIGHT, RIGHT]))


def arm_pressed():
    machine = statics.Machine(CRAWLER)
    with Instrument() as plant:
        press_down(plant)
        report = plant.report()
    _, load = three_points(machine, report)
    tip = report.forces(part=4)[:, 2].sum()
    crawler = sorted(report.forces(part=RIGHT)[:, 2])
    yield Quantity(
        "arm pressed down",
        "load left on the left crawler",
        "N",
        "none: lifted",
        0,
        report.forces(part=LEFT)[:, 2].sum(),
        0,
    )
    yield Quantity("arm pressed down", "load on the tip", "N", "lever rule", load[0], tip, 2e-3 * load[0])
    yield Quantity(
        "arm pressed down",
        "load on the right crawler, lighter end",
        "N",
        "lever rule",
        min(load[1:]),
        crawler[0],
        2e-3 * load[1],
    )


def pressing_torques():
    """What holds the arm down: load and weights, by virtual work. Nothing pulls level, so the belts bear nothing."""
    machine = statics.Machine(CRAWLER)
    with Instrument() as plant:
        press_down(plant)
        plant.run(8)  # until the integral part of the drives is through
        report = plant.report()
    _, load = three_points(machine, report)
    expected = np.concatenate([np.zeros(2), statics.holding_torques(machine, report, load[0])])
    names = ("left drive", "right drive", "swing", "boom", "arm")
    for name, reference, torque in zip(names, expected, report.actuator_effort, strict=True):
        yield Quantity(
            "arm pressed down",
            f"torque of the {name}",
            "N m",
            "virtual work",
            reference,
            torque,
            0.1 + 1e-3 * abs(reference),
        )


def lifting_drive():
    """The arm holds up the dead side, the other crawler drives."""
    machine = statics.Machine(CRAWLER)
    with Instrument() as plant:
        press_down(plant)
        plant.run(2, 0, SPEED)
        start = plant.report()
        rate, end = plant.turning_rate(1, 0, SPEED)
    motion, pull = statics.least_power(lifted_footing(machine, end), (0, SPEED))
    torque = machine.crawlers[RIGHT].radius * pull[RIGHT]
    yield Quantity("lifting drive", "yaw rate", "rad/s", "least power", motion[2], rate, 0.01 * abs(motion[2]))
    yield Quantity(
        "lifting drive",
        "torque of the right drive",
        "N m",
        "least power",
        torque,
        end.actuator_effort[RIGHT],
        0.01 * torque,
    )
    yield Quantity(
        "lifting drive", "roll lost on the way", "rad", "none: the arm holds", 0, start.roll - end.roll, 1e-3
    )
