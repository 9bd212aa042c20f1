"""A robot that falls, lies or stands: momentum, energy and loads."""

import numpy as np

from limphome_lab.measure.instrument import CRAWLER, SOUND, SWING, Instrument
from limphome_lab.measure.validation import statics
from limphome_lab.measure.validation.cases.quantity import SPEED, G, Quantity
from limphome_lab.measure.validation.robots import changed_robot, torque_limits


def free_fall():
    with Instrument() as plant:
        plant.lift(3)
        start = plant.report()
        plant.run(0.7, 0, 0, SPEED, SPEED, -SPEED)  # the arm moves; the centre of mass must not notice
        end = plant.report()
    yield Quantity("free fall", "speed after 0.7 s, arm moving", "m/s", "g t", G * 0.7, -end.velocity[2], 1e-3)
    # velocities are those at the end of each time step: the way is one half step's fall longer
    yield Quantity(
        "free fall",
        "height lost",
        "m",
        "g t (t + time step) / 2",
        0.5 * G * 0.7 * 0.705,
        (start.centre_of_mass - end.centre_of_mass)[2],
        1e-3,
    )
    yield Quantity(
        "free fall",
        "sideways drift",
        "m",
        "none",
        0,
        np.linalg.norm((start.centre_of_mass - end.centre_of_mass)[:2]),
        1e-3,
    )


def rest():
    machine = statics.Machine(CRAWLER)
    with Instrument() as plant:
        plant.run(1)
        start = plant.report()
        plant.run(60)
        end = plant.report()
    front = statics.on_crawlers(machine, 1.0).friction[[0, 1, 4, 5]].sum()
    heights = [contact["force"][2] for contact in end.contacts if contact["point"][1] > 0]  # it faces +y
    yield Quantity("rest", "drift in 60 s", "mm", "none", 0, 1e3 * np.linalg.norm(end.position - start.position), 0.01)
    yield Quantity("rest", "load on the ground", "N", "m g", machine.weight, end.forces()[:, 2].sum(), 0.1)
    yield Quantity("rest", "load on the front ends", "N", "lever rule", front, sum(heights), 1e-3 * front)


def swing_without_friction():
    """Momentum: the ground only bears, so swinging turns the base back, about a centre of mass that stays."""
    machine = statics.Machine(CRAWLER)
    with Instrument((*SOUND, "simulator.friction_crawler=0")) as plant:
        start = plant.report()
        plant.run(3, 0, 0, SPEED)
        end = plant.report()
    turned = (end.heading - start.heading) / (end.actuator_position - start.actuator_position)[SWING]
    expected = statics.yaw_per_swing(machine, machine.home)
    drift = np.linalg.norm((end.centre_of_mass - start.centre_of_mass)[:2])
    case = "swinging without friction"
    yield Quantity(case, "turn of the base per turn of the swing", "1", "angular momentum", expected, turned, 1e-3)
    yield Quantity(case, "drift of the centre of mass", "mm", "momentum", 0, 1e3 * drift, 0.1)


def _largest_rise(time_step):
    """Of the energy of a robot dropped with its drives off, over the energy dropped."""
    height = 0.2
    names = ("left_crawler", "right_crawler", "swing", "boom", "arm")
    machine = statics.Machine(CRAWLER)
    stiffness = machine.weight / 8 / 1e-3  # of the ground at each of eight points; sinkage 1 mm
    energies = []
    settings = (*SOUND, f"simulator.time_step_s={time_step}")
    with changed_robot(torque_limits(1e-9, *names)) as robot, Instrument(settings, robot) as plant:
        plant.lift(height)
        for _ in range(round(3 / time_step)):
            report = plant.report()
            # points are reported half way between the ground and the depth of penetration
            springs = sum(0.5 * stiffness * (2 * contact["point"][2]) ** 2 for contact in report.contacts)
            energies.append(report.kinetic_energy + machine.weight * report.centre_of_mass[2] + springs)
            plant.run(time_step)
    return np.max(energies - np.minimum.accumulate(energies)) / (machine.weight * height)


def passive():
    """What rises is the error of integrating the arm, which swings freely; it goes with the time step."""
    for time_step, tolerance in ((0.005, 0.002), (0.001, 0.0005)):
        yield Quantity(
            f"drives off, dropped from 0.2 m, step {1e3 * time_step:g} ms",
            "rise of energy / energy dropped",
            "1",
            "none: it only falls",
            0,
            _largest_rise(time_step),
            tolerance,
        )
