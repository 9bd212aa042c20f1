"""How the answers depend on time step and iterations: what the defaults were chosen from."""

import numpy as np

from limphome_lab.measure.instrument import CRAWLER, LEFT_LOCKED, Instrument
from limphome_lab.measure.validation import statics
from limphome_lab.measure.validation.cases.quantity import MU, SPEED

TIME_STEPS = (0.02, 0.01, 0.005, 0.0025, 0.001)  # [s]
ITERATIONS = (2, 5, 10, 20, 50, 200)
QUICK_STEP = 0.005
FINEST = 0.00025


def _settings(time_step, iterations):
    return (*LEFT_LOCKED, f"simulator.time_step_s={time_step}", f"simulator.solver_iterations={iterations}")


def _skid(settings):
    with Instrument(settings) as plant:
        plant.run(3, 0, SPEED)
        return plant.turning_rate(4, 0, SPEED)[0]


def _drag(settings):
    """Where the robot is after pressing down with the arm and dragging itself; and processor time per second."""
    with Instrument(settings) as plant:
        plant.run(5, 0, 0, 0.3, -0.15)
        plant.run(2, 0, 0, 0, -0.3)
        plant.run(4, 0, SPEED, -0.3)
        end = plant.report()
    return end.position[:2], end.time / end.cpu_s


def measure():
    """Yaw rate with the left crawler locked, way travelled in a drag with the arm, real-time factor: for each setting,
    with the errors against the quasi-static rate and the finest step."""
    motion, _ = statics.least_power(statics.on_crawlers(statics.Machine(CRAWLER), MU), (0, SPEED))
    finest, _ = _drag(_settings(FINEST, 200))
    rows = []
    for time_step, iterations in [(t, 50) for t in TIME_STEPS] + [(QUICK_STEP, n) for n in ITERATIONS]:
        settings = _settings(time_step, iterations)
        rate = _skid(settings)
        place, factor = _drag(settings)
        rows.append(
            {
                "time_step_s": time_step,
                "iterations": iterations,
                "yaw_rate": rate,
                "yaw_rate_error": rate / motion[2] - 1,
                "place_error_mm": 1e3 * float(np.linalg.norm(place - finest)),
                "real_time_factor": factor,
            }
        )
    return rows
