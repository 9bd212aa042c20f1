"""What is to be seen of a robot at a moment, wherever it comes from: a running plant, a recording."""

from dataclasses import dataclass

import numpy as np

from limphome import ground_truth_t


@dataclass
class Frame:
    """Frames, units and actuators as in lcmtypes/limphome_robot_state.lcm and limphome_ground_truth.lcm."""

    time: float  # of the plant [s]
    session: int
    position: np.ndarray  # [3]
    orientation: np.ndarray  # [4] w, x, y, z
    actuator_position: np.ndarray  # [actuators]
    health: np.ndarray  # [actuators], constants of robot_state_t
    centre_of_mass: np.ndarray | None = None  # [3]
    contact_point: np.ndarray | None = None  # [contacts x 3] with the ground
    contact_force: np.ndarray | None = None  # [contacts x 3]
    support: np.ndarray | None = None  # [vertices x 3]
    margin: float | None = None  # of stability [m]


def frame_of(message, truth=None):
    """Of a pose_t, or of a robot_state_t and the ground_truth_t of the same moment where there is one."""
    used = message.num_actuators
    frame = Frame(
        time=message.utime / 1e6,
        session=message.session,
        position=np.array(message.position),
        orientation=np.array(message.orientation),
        actuator_position=np.array(message.actuator_position[:used]),
        health=np.array(message.actuator_health[:used]),
    )
    if getattr(message, "has_truth", 0):
        truth = message.truth
    if truth is not None:
        on_ground = np.array(truth.contact_with[: truth.num_contacts]) == ground_truth_t.GROUND
        frame.centre_of_mass = np.array(truth.centre_of_mass)
        frame.contact_point = np.array(truth.contact_point)[: truth.num_contacts][on_ground]
        frame.contact_force = np.array(truth.contact_force)[: truth.num_contacts][on_ground]
        frame.support = np.array(truth.support)[: truth.num_support]
        frame.margin = truth.stability_margin
    return frame
