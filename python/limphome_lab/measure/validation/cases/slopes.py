"""Slopes, by a gravity that is tilted."""

import math

import numpy as np

from limphome_lab.measure.instrument import CRAWLER, LEFT, LEFT_FREE, LEFT_LOCKED, RIGHT, SOUND, Instrument
from limphome_lab.measure.validation import statics
from limphome_lab.measure.validation.bisection import limit
from limphome_lab.measure.validation.cases.quantity import MU, SPEED, G, Quantity
from limphome_lab.measure.validation.robots import changed_robot, torque_limits
from limphome_lab.robot import rotation_about


def rolling_down():
    """A robot whose drives are both free on a slope: only the sprockets' inertia holds it back."""
    angle = math.radians(20)
    with changed_robot(torque_limits(1e-6, "right_crawler")) as robot:
        machine = statics.Machine(robot)
        with Instrument(LEFT_FREE, robot) as plant:
            plant.slope(angle)
            plant.run(2)
            speed = -plant.report().velocity[1]
    rotors = sum(machine.sprocket_inertia / crawler.radius**2 for crawler in machine.crawlers)
    expected = 2 * G * math.sin(angle) * machine.mass / (machine.mass + rotors)
    yield Quantity(
        "both free on 20 deg", "speed after 2 s", "m/s", "g t sin(a) m / (m + J/r^2)", expected, speed, 5e-3 * expected
    )


def speed_uphill(degrees, settings, command, robot=CRAWLER):
    with Instrument(settings, robot) as plant:
        plant.slope(math.radians(degrees))
        plant.run(3, command, command)
        return plant.report().velocity[1]


def slopes():
    mu = 0.5
    friction = f"simulator.friction_crawler={mu}"
    angle = math.degrees(math.atan(mu))
    slides = limit(lambda a: speed_uphill(a, (*LEFT_LOCKED, friction), 0) > -1e-3, 20, 35, 0.02)
    climbs = limit(lambda a: speed_uphill(a, (*SOUND, friction), SPEED) > 1e-3, 20, 35, 0.02)
    yield Quantity("slope, friction 0.5", "angle at which it slides", "deg", "atan(mu)", angle, slides, 0.05)
    yield Quantity("slope, friction 0.5", "steepest it climbs", "deg", "atan(mu)", angle, climbs, 0.05)

    machine = statics.Machine(CRAWLER)
    with Instrument(SOUND) as plant:
        plant.slope(math.radians(15))
        plant.run(4, SPEED, SPEED)
        torque = plant.report().actuator_effort[[LEFT, RIGHT]].sum()
    expected = machine.weight * math.sin(math.radians(15)) * machine.crawlers[RIGHT].radius
    yield Quantity(
        "slope of 15 deg", "torque of both drives climbing", "N m", "m g r sin(a)", expected, torque, 2e-3 * expected
    )


def _downhill_behind(angle):
    """Gravity in the world for a robot that faces up a slope."""
    return (0, -G * math.sin(angle), -G * math.cos(angle))


def _downhill_across(angle):
    """For one that faces along it, downhill to its right."""
    return (G * math.sin(angle), 0, -G * math.cos(angle))


def ramp_grid():
    """Friction against angle: brakes hold and belts climb where tan(a) < mu; elsewhere it slides as Coulomb says."""
    frictions, angles = (0.2, 0.4, 0.6, 0.8, 1.0), np.radians((5, 10, 15, 20, 25, 30, 35, 40))
    agree, worst = {"holds or slides": 0, "climbs or does not": 0}, 0.0
    for mu in frictions:
        with Instrument((*SOUND, f"simulator.friction_crawler={mu}")) as plant:
            for angle in angles:
                expected = math.tan(angle) < mu
                speeds = []
                for command in (0, SPEED):
                    plant.reset()
                    plant.slope(angle)
                    for seconds in (0.5, 0.5):
                        plant.run(seconds, command, command)
                        speeds.append(plant.report().velocity[1])
                agree["holds or slides"] += expected == (speeds[1] > -1e-3)
                agree["climbs or does not"] += expected == (speeds[3] > 1e-3)
                if not expected:
                    sliding = -G * (math.sin(angle) - mu * math.cos(angle))
                    worst = max(worst, *(abs((b - a) / 0.5 - sliding) for a, b in (speeds[:2], speeds[2:])))
    cells = len(frictions) * len(angles)
    case = "ramps of 5 to 40 deg, friction 0.2 to 1"
    for what, count in agree.items():
        yield Quantity(case, f"cells where it {what} as it should", "1", "tan(a) < mu", cells, count, 0)
    yield Quantity(case, "largest error of sliding", "m/s^2", "g (sin(a) - mu cos(a))", 0, worst, 1e-3)


def holding():
    """Standing on a slope for a minute, drives at rest."""
    steep = math.radians(30)
    for name, gravity in (("uphill", _downhill_behind(steep)), ("across", _downhill_across(steep))):
        with Instrument(SOUND) as plant:
            plant.gravity(gravity)
            plant.run(10)
            start = plant.report()
            plant.run(60)
            creep = np.linalg.norm(plant.report().position - start.position)
        yield Quantity(f"standing {name} on 30 deg", "creep in 60 s", "mm", "none", 0, 1e3 * creep, 1e-3)


def _across_motion(machine, gravity, speeds, heading):
    """Quasi-static motion on the slope that `gravity` stands for: (downhill speed of the origin, yaw rate)."""
    turn = rotation_about((0, 0, 1), heading)
    own = turn.T @ gravity
    centre = machine.centre_of_mass(machine.frames(machine.home))
    force = machine.mass * own[:2]
    push = (*force, centre[0] * force[1] - centre[1] * force[0])
    footing = statics.on_crawlers(machine, MU, gravity=own)
    motion, _ = statics.least_power(footing, speeds, push)
    return (turn @ [motion[0], motion[1], 0])[0], motion[2]


def across():
    """Side slope: straight on it does not drift, as nothing slips; turning it does."""
    machine = statics.Machine(CRAWLER)
    gravity = np.array(_downhill_across(math.radians(15)))
    with Instrument(SOUND) as plant:
        plant.gravity(gravity)
        plant.run(3, SPEED, SPEED)
        start = plant.report()
        plant.run(10, SPEED, SPEED)
        end = plant.report()
    moved = end.position - start.position
    yield Quantity("straight across 15 deg", "drift downhill in 3 m", "mm", "none", 0, 1e3 * moved[0], 1)
    turned = math.degrees(end.heading - start.heading)
    yield Quantity("straight across 15 deg", "turned in 3 m", "deg", "none", 0, turned, 0.01)
    for name, settings, speeds in (("left locked", LEFT_LOCKED, (0, 0.1)), ("turn on the spot", SOUND, (-0.1, 0.1))):
        with Instrument(settings) as plant:
            plant.gravity(gravity)
            plant.run(5, *speeds)
            before = plant.report()
            rate, after = plant.turning_rate(1, *speeds)
        heading = 0.5 * (before.heading + after.heading)
        drift, turning = _across_motion(machine, gravity, speeds, heading)
        drifted = after.position[0] - before.position[0]
        case = f"{name}, across 15 deg"
        yield Quantity(case, "drift downhill", "m/s", "least power", drift, drifted, 0.01 * abs(drift))
        yield Quantity(case, "yaw rate", "rad/s", "least power", turning, rate, 0.01 * abs(turning))


def _tilted_across(degrees):
    """Report of a robot on a ground that has been tilted slowly, friction enough."""
    with Instrument((*SOUND, "simulator.friction_crawler=2")) as plant:
        for share in np.linspace(0.02, 1, 50):
            plant.gravity(_downhill_across(math.radians(share * degrees)))
            plant.run(0.1)
        plant.run(2)
        return plant.report()


def tipping():
    """Steepest side slopes. The uphill crawler is off the ground once the other alone, on its springs, carries so that
    none of it would rise; the robot tumbles once the weight is over the outer edge, on whose springs it leans."""
    machine = statics.Machine(CRAWLER)
    height = machine.centre_of_mass(machine.frames(machine.home))[2]
    right, left = machine.crawlers[RIGHT], machine.crawlers[LEFT]
    edges = np.array([right.centre[1] + side * right.width for side in (0.5, -0.5)])
    sunk = left.centre[1] - 0.5 * left.width - edges  # in proportion, as the inner edge on the left just touches
    lifts = math.degrees(math.atan2(-(edges @ sunk) / sunk.sum(), height))
    edge = math.atan2(-edges.min(), height)
    lean = 1e-3 * 8 / 2 * math.cos(edge) / right.width  # 1 mm on all eight points, here on two
    found = limit(lambda angle: _tilted_across(angle).forces(part=LEFT)[:, 2].sum() > 0, 30, 60, 0.05)
    yield Quantity("side slope, friction 2", "uphill crawler leaves the ground", "deg", "lever rule", lifts, found, 0.2)
    found = limit(lambda angle: abs(_tilted_across(angle).roll) < 0.1, 30, 60, 0.05)
    tumbles = math.degrees(edge - lean)
    yield Quantity("side slope, friction 2", "tumbles", "deg", "lever rule", tumbles, found, 0.2)


def swinging():
    """The upper body swings to and fro as fast as it can, the robot stands on a slope: neither slips nor lifts off."""
    fastest = 1.0  # [rad/s]
    quarter = 0.5 * math.pi / fastest
    steep = math.radians(15)
    for name, gravity in (("uphill", _downhill_behind(steep)), ("across", _downhill_across(steep))):
        with Instrument(SOUND) as plant:
            plant.gravity(gravity)
            plant.run(8)
            start = plant.report()
            heights = []
            for direction in (1, -1, -1, 1) * 3:
                for _ in range(10):
                    plant.run(0.1 * quarter, 0, 0, direction * fastest)
                    heights.append(plant.report().position[2])
            plant.run(8)
            end = plant.report()
        case = f"swinging to and fro, {name} on 15 deg"
        slid = np.linalg.norm((end.position - start.position)[:2])
        turned = math.degrees(end.heading - start.heading)
        rise = max(heights) - start.position[2]
        yield Quantity(case, "slid in 3 swings", "mm", "none: friction suffices", 0, 1e3 * slid, 0.1)
        yield Quantity(case, "turned in 3 swings", "deg", "none: friction suffices", 0, turned, 0.01)
        yield Quantity(case, "rise", "mm", "none but the ground's springs", 0, 1e3 * rise, 0.5)
