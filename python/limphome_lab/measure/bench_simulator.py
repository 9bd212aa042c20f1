"""Speed of the simulator beside MuJoCo and PyBullet: the same robot and the same random actions, in turns, in one run.

PYTHONPATH=python .venv/bin/python -m limphome_lab.measure.bench_simulator
"""

import os
import random
import statistics
import sys
import time

from limphome_lab.measure.instrument import CRAWLER, LEFT_LOCKED, Instrument

DECISIONS = 20  # of a round; a robot starts anew with each
PERIOD = 0.5  # of a decision [s]
ROUNDS = 9
LEVELS = (-0.3, 0.0, 0.3)  # Table 1 [m/s, rad/s]
OUR_STEP = 0.005  # default of simulator.time_step_s


def _ours(actions):
    with Instrument(LEFT_LOCKED) as plant:
        for action in actions:
            plant.run(PERIOD, *action)
        return plant.report().cpu_s


def _drag(plant, periods):
    """The healthy crawler drives, the arm joints sweep to and fro, never far enough to tumble."""
    for i in range(periods):
        sign = 1 if i % 4 < 2 else -1
        plant.run(PERIOD, 0.3, 0.3, 0.1 * sign, 0.1 * sign, -0.1 * sign)


def real_time_factor():
    """Simulated over processor time while the robot drags itself along."""
    with Instrument(LEFT_LOCKED) as plant:
        _drag(plant, 10)  # warms up
        warm = plant.report().cpu_s
        plant.reset()
        _drag(plant, 60)
        end = plant.report()
        return end.time / (end.cpu_s - warm)


def _timed(plant, actions):
    begin = time.process_time()
    for action in actions:
        plant.run(PERIOD, *action)
    return time.process_time() - begin


def _mujoco(options):
    from limphome_lab.measure.validation.mujoco_robot import MujocoPlant

    return lambda actions: _timed(MujocoPlant(CRAWLER, options=options), actions)


def _pybullet(wheels):
    from limphome_lab.measure.validation.pybullet_robot import PybulletPlant

    def run(actions):
        plant = PybulletPlant(CRAWLER, wheels)
        seconds = _timed(plant, actions)
        plant.close()
        return seconds

    return run


def _rivals():
    """{name: (processor time for some actions, time step)} of those that are installed."""
    rivals = {}
    try:
        from limphome_lab.measure.validation.mujoco_robot import DEFAULTS, ELLIPTIC

        rivals["mujoco"] = (_mujoco(ELLIPTIC), 1 / 240)
        rivals["mujoco_pyramidal"] = (_mujoco(DEFAULTS), 1 / 240)
    except ImportError as error:
        print(f"MuJoCo skipped: {error}", file=sys.stderr)
    try:
        rivals["pybullet_boxes"] = (_pybullet(wheels=False), 1 / 240)
        rivals["pybullet_ten_wheels"] = (_pybullet(wheels=True), 1 / 240)
    except ImportError as error:
        print(f"PyBullet skipped: {error}", file=sys.stderr)
    return rivals


def _rounds(engines):
    """{name: [processor time]}, a round of each in turn, so that what else the machine does hits all alike."""
    seconds = {name: [] for name in engines}
    for seed in range(ROUNDS):
        generator = random.Random(seed)
        # the left crawler is locked
        actions = [[0.0] + [generator.choice(LEVELS) for _ in range(4)] for _ in range(DECISIONS)]
        for name, (run, _) in engines.items():
            seconds[name].append(run(actions))
    return seconds


def measure():
    """Figures of scripts/bench: ours as the value, another engine as the baseline; a ratio above 1: ours is faster."""
    cores = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(cores)})  # one core for all
    try:
        rivals = _rivals()
        seconds = _rounds({"limphome": (_ours, OUR_STEP)} | rivals)
    finally:
        os.sched_setaffinity(0, cores)
    simulated = DECISIONS * PERIOD
    ours = statistics.median(seconds["limphome"])
    for name, (_, time_step) in rivals.items():
        ratio = statistics.median(theirs / own for theirs, own in zip(seconds[name], seconds["limphome"], strict=True))
        theirs = statistics.median(seconds[name])
        yield {
            "name": f"simulator_step_real_time_factor_{name}",
            "value": simulated / ours,
            "unit": "s/s",
            "baseline": simulated / theirs,
            "ratio": ratio,
            "what": f"simulated over processor time, against {name}",
        }
        yield {
            "name": f"simulator_step_{name}",
            "value": simulated / ours / OUR_STEP,
            "unit": "1/s",
            "baseline": simulated / theirs / time_step,
            "ratio": ratio * time_step / OUR_STEP,
            "what": f"time steps of {1e3 * OUR_STEP:g} ms, against {name}'s of {1e3 * time_step:.3g} ms",
        }


def main():
    for row in measure():
        print(row)


if __name__ == "__main__":
    main()
