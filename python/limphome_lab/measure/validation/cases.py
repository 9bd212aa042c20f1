"""The cases: each yields quantities with a reference, where that comes from, and what the simulator gave."""

import math
from dataclasses import asdict, dataclass

import numpy as np

from limphome_lab.measure.instrument import CRAWLER, LEFT, LEFT_FREE, LEFT_LOCKED, RIGHT, SOUND, Instrument
from limphome_lab.measure.validation import statics
from limphome_lab.measure.validation.robots import base_centre_at, changed_robot, torque_limits

G = statics.GRAVITY
MU = 0.7  # of paper.ini
SPEED = 0.3  # of the belts, Table 1 [m/s]
QUARTER_TURN_S = 0.5 * math.pi / SPEED  # of the swing joint at its speed of Table 1


@dataclass
class Quantity:
    case: str
    quantity: str
    unit: str
    source: str  # of the reference
    reference: float
    measured: float
    tolerance: float  # largest |measured - reference|, in `unit`

    @property
    def error(self):
        return self.measured - self.reference

    @property
    def passed(self):
        return abs(self.error) <= self.tolerance

    def as_dict(self):
        numbers = {name: float(getattr(self, name)) for name in ("reference", "measured", "tolerance", "error")}
        return asdict(self) | numbers | {"passed": bool(self.passed)}


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


def straight_drive():
    with Instrument(SOUND) as plant:
        plant.run(1, SPEED, SPEED)
        start = plant.report()
        plant.run(10, SPEED, SPEED)
        end = plant.report()
    moved = end.position - start.position
    yield Quantity("straight drive", "speed", "m/s", "belt speed", SPEED, moved[1] / 10, 1e-3 * SPEED)
    yield Quantity("straight drive", "sideways in 3 m", "mm", "none", 0, 1e3 * moved[0], 1)
    # The drives may hold each other in a grip that Coulomb's law leaves open; on the robot it has no effect.
    yield Quantity(
        "straight drive",
        "torque of both drives",
        "N m",
        "none: nothing resists",
        0,
        end.actuator_effort[[LEFT, RIGHT]].sum(),
        0.5,
    )


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


def _limit(holds, low, high, resolution):
    """Where `holds` turns from true (at low) to false (at high)."""
    while high - low > resolution:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if holds(middle) else (low, middle)
    return 0.5 * (low + high)


def _speed_uphill(degrees, settings, command, robot=CRAWLER):
    with Instrument(settings, robot) as plant:
        plant.slope(math.radians(degrees))
        plant.run(3, command, command)
        return plant.report().velocity[1]


def slopes():
    mu = 0.5
    friction = f"simulator.friction_crawler={mu}"
    limit = math.degrees(math.atan(mu))
    slides = _limit(lambda a: _speed_uphill(a, (*LEFT_LOCKED, friction), 0) > -1e-3, 20, 35, 0.02)
    climbs = _limit(lambda a: _speed_uphill(a, (*SOUND, friction), SPEED) > 1e-3, 20, 35, 0.02)
    yield Quantity("slope, friction 0.5", "angle at which it slides", "deg", "atan(mu)", limit, slides, 0.05)
    yield Quantity("slope, friction 0.5", "steepest it climbs", "deg", "atan(mu)", limit, climbs, 0.05)

    machine = statics.Machine(CRAWLER)
    with Instrument(SOUND) as plant:
        plant.slope(math.radians(15))
        plant.run(4, SPEED, SPEED)
        torque = plant.report().actuator_effort[[LEFT, RIGHT]].sum()
    expected = machine.weight * math.sin(math.radians(15)) * machine.crawlers[RIGHT].radius
    yield Quantity(
        "slope of 15 deg", "torque of both drives climbing", "N m", "m g r sin(a)", expected, torque, 2e-3 * expected
    )


def stall():
    """Drives that are too weak: uphill, and to drag the locked side round."""
    machine = statics.Machine(CRAWLER)
    with changed_robot(torque_limits(300, "left_crawler", "right_crawler")) as robot:
        steepest = _limit(lambda a: _speed_uphill(a, SOUND, SPEED, robot) > 1e-3, 10, 30, 0.02)
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
        _limit(stalls, 0.8 * expected, 1.2 * expected, 0.5),
        5e-3 * expected,
    )


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
    for time_step, tolerance in ((0.005, 0.05), (0.001, 0.005)):
        yield Quantity(
            f"drives off, dropped from 0.2 m, step {1e3 * time_step:g} ms",
            "rise of energy / energy dropped",
            "1",
            "none: it only falls",
            0,
            _largest_rise(time_step),
            tolerance,
        )


ALL = (
    free_fall,
    rest,
    straight_drive,
    locked_crawler,
    free_crawler,
    counter_rotation,
    rolling_down,
    drawbar_pull,
    slopes,
    stall,
    arm_pressed,
    lifting_drive,
    passive,
)


def measure(progress=lambda name: None):
    quantities = []
    for case in ALL:
        progress(case.__name__.replace("_", " "))
        quantities += case()
    return quantities
