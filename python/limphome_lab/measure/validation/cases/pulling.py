"""What the belts can pull, and what holds them back."""

import math

from limphome_lab.measure.instrument import CRAWLER, LEFT, LEFT_FREE, LEFT_LOCKED, RIGHT, SOUND, Instrument
from limphome_lab.measure.validation import statics
from limphome_lab.measure.validation.bisection import limit
from limphome_lab.measure.validation.cases.quantity import MU, SPEED, G, Quantity
from limphome_lab.measure.validation.cases.slopes import speed_uphill
from limphome_lab.measure.validation.robots import changed_robot, torque_limits


def drawbar_pull():
    """Pulled back by 1.2 times what friction can hold, both belts forward."""
    mu = 0.5
    machine = statics.Machine(CRAWLER)
    with Instrument((*SOUND, f"simulator.friction_crawler={mu}")) as plant:
        plant.gravity((0, -1.2 * mu * G, -G))
        plant.run(0.5, SPEED, SPEED)
        before = plant.report()
        plant.run(0.5, SPEED, SPEED)
        end = plant.report()
    pull = mu * machine.weight
    torque = pull * machine.crawlers[RIGHT].radius
    effort = end.actuator_effort[[LEFT, RIGHT]].sum()
    yield Quantity("drawbar pull", "pull, belts slipping", "N", "mu m g", pull, end.forces()[:, 1].sum(), 2e-3 * pull)
    yield Quantity("drawbar pull", "torque of both drives", "N m", "mu m g r", torque, effort, 5e-3 * torque)
    yield Quantity(
        "drawbar pull",
        "acceleration",
        "m/s^2",
        "mu g - 1.2 mu g",
        -0.2 * mu * G,
        (end.velocity - before.velocity)[1] / 0.5,
        0.01,
    )


def pull_and_slip():
    """Coulomb's curve is a step: no slip up to mu m g, and mu m g at any slip."""
    mu = 0.5
    most = mu * statics.Machine(CRAWLER).weight
    settings = (*SOUND, f"simulator.friction_crawler={mu}")

    def slip(report):
        return 1 - report.velocity[1] / report.actuator_velocity[[LEFT, RIGHT]].mean()

    for share in (0.25, 0.5, 0.75, 0.95):
        with Instrument(settings) as plant:
            plant.gravity((0, -share * mu * G, -G))
            plant.run(3, SPEED, SPEED)
            found = 100 * slip(plant.report())
        yield Quantity(f"pull of {share:g} mu m g", "slip", "%", "Coulomb", 0, found, 0.01)
    with Instrument(settings) as plant:
        plant.gravity((0, -0.95 * mu * G, -G))
        plant.run(3, SPEED, SPEED)
        plant.gravity((0, -1.1 * mu * G, -G))
        report = plant.report()
        for wanted in (0.1, 0.25, 0.5, 1.0, 2.0):
            while slip(report) < wanted:
                plant.run(0.005, SPEED, SPEED)
                report = plant.report()
            pull = report.forces()[:, 1].sum()
            yield Quantity(f"slip of {100 * wanted:g} %", "pull", "N", "mu m g", most, pull, 2e-3 * most)


def motion_resistance():
    """A robot that rolls freely on level ground: belts have no losses, so it keeps its speed."""
    with changed_robot(torque_limits(1e-6, "right_crawler")) as robot, Instrument(LEFT_FREE, robot) as plant:
        plant.slope(math.radians(-10))
        plant.run(1)
        plant.slope(0)
        plant.run(1)
        start = plant.report()
        plant.run(5)
        end = plant.report()
    machine = statics.Machine(CRAWLER)
    rotors = sum(machine.sprocket_inertia / crawler.radius**2 for crawler in machine.crawlers)
    resistance = (machine.mass + rotors) * (start.velocity - end.velocity)[1] / 5
    yield Quantity("both free, level", "motion resistance", "N", "none in the model", 0, resistance, 0.01)
    yield Quantity(
        "both free, level", "slip", "%", "none", 0, 100 * (1 - end.velocity[1] / end.actuator_velocity[LEFT]), 0.01
    )


def stall():
    """Drives that are too weak: uphill, and to drag the locked side round."""
    machine = statics.Machine(CRAWLER)
    with changed_robot(torque_limits(300, "left_crawler", "right_crawler")) as robot:
        steepest = limit(lambda a: speed_uphill(a, SOUND, SPEED, robot) > 1e-3, 10, 30, 0.02)
    expected = math.degrees(math.asin(2 * 300 / (machine.crawlers[RIGHT].radius * machine.weight)))
    yield Quantity(
        "drives limited to 300 N m", "steepest it climbs", "deg", "asin(2 T / (r m g))", expected, steepest, 0.05
    )

    def stalls(torque):
        with changed_robot(torque_limits(torque, "right_crawler")) as weak, Instrument(LEFT_LOCKED, weak) as plant:
            plant.run(4, 0, SPEED)
            return plant.report().actuator_velocity[RIGHT] < 0.01

    _, pull = statics.least_power(statics.on_crawlers(machine, MU), (0, SPEED))
    expected = machine.crawlers[RIGHT].radius * pull[RIGHT]
    yield Quantity(
        "left locked",
        "torque limit below which it stalls",
        "N m",
        "least power",
        expected,
        limit(stalls, 0.8 * expected, 1.2 * expected, 0.5),
        5e-3 * expected,
    )
