"""Torques of drives whose belts do not slip: what has no effect on the motion must not load them.

Coulomb's law leaves open how points that stick share what they do; shared by load, nothing pulls against anything. Each
is measured once the integral part of the drives is through: while it lets the belts creep, friction holds in full."""

import math

import numpy as np

from limphome_lab.measure.instrument import CRAWLER, LEFT, LEFT_LOCKED, RIGHT, SOUND, Instrument
from limphome_lab.measure.validation import statics
from limphome_lab.measure.validation.cases.quantity import QUARTER_TURN_S, SPEED, Quantity
from limphome_lab.measure.validation.robots import base_centre_at, changed_robot, torque_limits

THROUGH_S = 8  # the integral part
SLOPE = math.radians(15)
LEFT_WEAK = ("failure.actuator=left_crawler", "failure.mode=weak", "failure.weak_factor=0.1")


def _unloaded(case, report):
    largest = np.abs(report.actuator_effort[[LEFT, RIGHT]]).max()
    return Quantity(case, "larger torque of the two drives", "N m", "none: nothing resists", 0, largest, 0.01)


def nothing_resists():
    with Instrument(SOUND) as plant:
        plant.run(THROUGH_S, SPEED, SPEED)
        yield _unloaded("straight drive", plant.report())
        plant.run(THROUGH_S, -SPEED, -SPEED)
        yield _unloaded("straight drive, reversed", plant.report())
        plant.slope(SLOPE)
        plant.run(4, SPEED, SPEED)
        plant.slope(0)
        plant.run(THROUGH_S, SPEED, SPEED)
        yield _unloaded("straight drive after a climb", plant.report())
        plant.run(QUARTER_TURN_S, 0, 0, SPEED)
        plant.run(5, 0, 0, 0, -SPEED)
        plant.run(3, 0, 0, -SPEED)
        plant.run(5, 0, 0, 0, SPEED)
        plant.run(THROUGH_S, SPEED, SPEED)
        yield _unloaded("straight drive after a push with the arm", plant.report())
    with Instrument(LEFT_WEAK) as plant:
        plant.run(3, -SPEED, SPEED)
        plant.run(THROUGH_S, SPEED, SPEED)
        yield _unloaded("straight drive, left at its limit before", plant.report())


def standing_after_turns():
    for case, settings, left in (("a turn on the spot", SOUND, -SPEED), ("a turn, left locked", LEFT_LOCKED, 0)):
        with Instrument(settings) as plant:
            plant.run(3, left, SPEED)
            plant.run(THROUGH_S)
            yield _unloaded(f"standing after {case}", plant.report())


def _on_slope(settings, speed, robot=CRAWLER):
    with Instrument(settings, robot) as plant:
        plant.slope(SLOPE)
        plant.run(THROUGH_S, speed, speed)
        return plant.report().actuator_effort[[LEFT, RIGHT]]


def loads_are_shared():
    """Uphill each drive bears what the load on its belt asks for, a weak one what it can and the other the rest."""
    machine = statics.Machine(CRAWLER)
    whole = machine.weight * math.sin(SLOPE) * machine.crawlers[LEFT].radius

    def shares(case, torques, left):
        for name, torque, expected in (("left", torques[LEFT], left), ("right", torques[RIGHT], whole - left)):
            source = "m g r sin(a), by load"
            yield Quantity(case, f"torque of the {name} drive", "N m", source, expected, torque, 1e-3 * whole)

    yield from shares("climbing 15 deg", _on_slope(SOUND, SPEED), whole / 2)
    yield from shares("standing on 15 deg, left locked", _on_slope(LEFT_LOCKED, 0), whole / 2)
    with changed_robot(base_centre_at(0, 0.15)) as robot:
        loads = statics.on_crawlers(statics.Machine(robot), 1.0).friction
        left = whole * loads[:4].sum() / loads.sum()
        yield from shares("climbing 15 deg, load to the left", _on_slope(SOUND, SPEED, robot), left)
    limit = 0.1 * 1000  # of the URDF's [N m]
    yield from shares("climbing 15 deg, left weak", _on_slope(LEFT_WEAK, SPEED), limit)


def stalled():
    """A drive too weak to drag the locked side pulls against it, along the belts."""
    limit = 300
    with changed_robot(torque_limits(limit, "right_crawler")) as robot, Instrument(LEFT_LOCKED, robot) as plant:
        plant.run(THROUGH_S, 0, SPEED)
        torques = plant.report().actuator_effort
    yield Quantity("stalled", "torque of the right drive", "N m", "its limit", limit, torques[RIGHT], 0.1)
    yield Quantity("stalled", "torque on the locked crawler", "N m", "balance of forces", -limit, torques[LEFT], 0.5)
