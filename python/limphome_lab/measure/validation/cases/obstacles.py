"""Steps and gaps that can be crossed, slowly, against balance at every stage of the way."""

import math

from limphome_lab.measure.instrument import CRAWLER, SOUND, Instrument
from limphome_lab.measure.validation import crossing, statics
from limphome_lab.measure.validation.bisection import limit
from limphome_lab.measure.validation.cases.quantity import MU, Quantity

TO_THE_STEP = 1.15  # [m]; robot and rounded edge meet a little later


def _gets_onto(height, mu):
    settings = ("ground.step_spacing_m=4", f"ground.step_height_m={height}", f"simulator.friction_crawler={mu}")
    with Instrument((*SOUND, *settings)) as plant:
        for way, speed in ((TO_THE_STEP, 0.3), (0.4, 0.02), (0.75, 0.05), (0.5, 0.3)):  # slow where it is hardest
            plant.run(way / speed, speed, speed)
        report = plant.report()
        return report.position[2] > 0.5 * height and abs(math.asin(report.axes[2, 0])) < 0.05


def steps():
    """Friction decides up to a height; beyond it the robot falls over backwards whatever the friction."""
    profile = crossing.Profile.of(statics.Machine(CRAWLER))
    for mu in (0.55, MU, 1.0):
        expected = limit(lambda h, mu=mu: crossing.gets_onto(profile, h, mu), 0.02, 0.4, 1e-3)
        found = limit(lambda h, mu=mu: _gets_onto(h, mu), 0.94 * expected, 1.06 * expected, 0.04 * expected)
        case = f"step, friction {mu}"
        yield Quantity(case, "highest it gets onto", "m", "balance on the way", expected, found, 0.04 * expected)


def _crosses(width):
    with Instrument((*SOUND, "ground.step_height_m=0.5", f"ground.step_spacing_m={width}")) as plant:
        plant.run(40, 0.05, 0.05)
        return plant.report().position[1] > 1.5


def gaps():
    """Strips and gaps of the same width, the robot at first over one: the rear end falls in once the gap is wider."""
    expected = crossing.widest_gap(crossing.Profile.of(statics.Machine(CRAWLER)))
    found = limit(_crosses, 0.96 * expected, 1.04 * expected, 0.01 * expected)
    yield Quantity("gap", "widest it crosses", "m", "weight over the far edge", expected, found, 0.015 * expected)
