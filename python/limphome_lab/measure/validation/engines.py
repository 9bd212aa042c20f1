"""The same manoeuvres in our simulator and in MuJoCo, side by side, and where the differences come from."""

import math
from dataclasses import asdict, dataclass

from limphome_lab.measure.instrument import CRAWLER, LEFT_LOCKED, RIGHT, SOUND, Instrument
from limphome_lab.measure.validation import statics
from limphome_lab.measure.validation.cases.arm import lifted_footing, press_down
from limphome_lab.measure.validation.cases.quantity import MU, SPEED
from limphome_lab.measure.validation.mujoco_robot import DEFAULTS, ELLIPTIC, MujocoPlant


@dataclass
class Comparison:
    quantity: str
    unit: str
    reference: float  # quasi-static
    ours: float
    mujoco: float  # elliptic cone, step of 1/240 s
    mujoco_default: float  # pyramidal cone, step of 1/240 s

    def as_dict(self):
        return asdict(self)


def _turned(plant, seconds, *rates):
    before = plant.heading
    plant.run(seconds, *rates)
    return math.remainder(plant.heading - before, 2 * math.pi) / seconds


def _mujoco_straight(options):
    plant = MujocoPlant(CRAWLER, options=options)
    plant.run(1, SPEED, SPEED)
    before = plant.position
    plant.run(4, SPEED, SPEED)
    return float(plant.position[1] - before[1]) / 4


def _mujoco_skid(options):
    plant = MujocoPlant(CRAWLER, options=options)
    plant.run(3, 0, SPEED)
    rate = _turned(plant, 4, 0, SPEED)
    return rate, plant.mean_drive_torque(RIGHT, 1)


def _mujoco_lifting(options):
    plant = MujocoPlant(CRAWLER, options=options)
    press_down(plant)
    plant.run(2, 0, SPEED)
    rate = _turned(plant, 1, 0, SPEED)
    return rate, plant.mean_drive_torque(RIGHT, 1)


def _our_straight():
    with Instrument(SOUND) as plant:
        plant.run(1, SPEED, SPEED)
        before = plant.report()
        plant.run(4, SPEED, SPEED)
        return (plant.report().position - before.position)[1] / 4


def _our_skid():
    with Instrument(LEFT_LOCKED) as plant:
        plant.run(3, 0, SPEED)
        rate, end = plant.turning_rate(4, 0, SPEED)
    return rate, end.actuator_effort[RIGHT]


def _our_lifting():
    with Instrument(LEFT_LOCKED) as plant:
        press_down(plant)
        plant.run(2, 0, SPEED)
        rate, end = plant.turning_rate(1, 0, SPEED)
    return rate, end


def compare():
    machine = statics.Machine(CRAWLER)
    radius = machine.crawlers[RIGHT].radius
    rows = [
        Comparison(
            "straight drive: speed",
            "m/s",
            SPEED,
            _our_straight(),
            _mujoco_straight(ELLIPTIC),
            _mujoco_straight(DEFAULTS),
        )
    ]

    def add(name, reference, ours, mujoco, default):
        motion, pull = reference
        rows.append(Comparison(f"{name}: yaw rate", "rad/s", float(motion[2]), ours[0], mujoco[0], default[0]))
        rows.append(
            Comparison(
                f"{name}: torque of the right drive",
                "N m",
                float(pull[RIGHT]) * radius,
                float(ours[1]),
                mujoco[1],
                default[1],
            )
        )

    add(
        "left locked",
        statics.least_power(statics.on_crawlers(machine, MU), (0, SPEED)),
        _our_skid(),
        _mujoco_skid(ELLIPTIC),
        _mujoco_skid(DEFAULTS),
    )
    rate, end = _our_lifting()
    add(
        "lifting drive",
        statics.least_power(lifted_footing(machine, end), (0, SPEED)),
        (rate, end.actuator_effort[RIGHT]),
        _mujoco_lifting(ELLIPTIC),
        _mujoco_lifting(DEFAULTS),
    )
    return rows


# What MuJoCo's yaw rate with the left crawler locked depends on: cone, step, stiffness of the ground.
VARIANTS = (
    ("pyramidal cone, 1/240 s", {"options": DEFAULTS}),
    ("pyramidal cone, 1 ms", {"options": DEFAULTS, "time_step": 0.001}),
    ("pyramidal cone, 1/240 s, heading turned by 45 deg", {"options": DEFAULTS, "heading": 0.75 * math.pi}),
    ("elliptic cone, 1/240 s", {}),
    ("elliptic cone, 1/240 s, heading turned by 45 deg", {"heading": 0.75 * math.pi}),
    ("elliptic cone, 1/240 s, ground 5 times softer in time", {"solref": (0.1, 1)}),
    ("elliptic cone, 1 ms", {"time_step": 0.001}),
)
SPEEDS = (0.3, 0.03, 0.003)  # of the belt [m/s]


def skid_by_speed():
    """Yaw rates at several belt speeds, scaled to the first, and points of contact that bear load meanwhile:
    quasi-static analysis knows no speed and has all eight bear load."""
    rows = [_mujoco_by_speed(name, options) for name, options in VARIANTS]
    return rows + [_ours_by_speed()]


def _mujoco_by_speed(name, options):
    row = {"engine": f"MuJoCo, {name}", "yaw_rates": [], "loaded_points": []}
    for speed in SPEEDS:
        plant = MujocoPlant(CRAWLER, **options)
        plant.run(3, 0, speed)
        row["yaw_rates"].append(_turned(plant, 4, 0, speed) * SPEED / speed)
        row["loaded_points"].append(plant.mean_loaded_corners(0.5))
    return row


def _ours_by_speed():
    row = {"engine": "limphome, 5 ms", "yaw_rates": [], "loaded_points": []}
    for speed in SPEEDS:
        with Instrument(LEFT_LOCKED) as plant:
            plant.run(3, 0, speed)
            rate, _ = plant.turning_rate(4, 0, speed)
            row["yaw_rates"].append(rate * SPEED / speed)
            counts = []
            for _ in range(100):
                plant.run(0.005, 0, speed)
                counts.append((plant.report().forces()[:, 2] > 1).sum())
            row["loaded_points"].append(float(sum(counts)) / len(counts))
    return row
