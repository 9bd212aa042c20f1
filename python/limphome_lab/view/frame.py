"""What is to be seen of a robot at a moment, wherever it comes from: a running plant, a recording."""

from dataclasses import dataclass

import numpy as np


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
