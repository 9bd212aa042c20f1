"""Where an episode is to end."""

import numpy as np

from limphome_lab import quaternion


def goal(decision, state):
    """(point [x, y] of the goal line, direction [rad] across which it lies) in the world, by a decision_t and the
    robot_state_t that it decided upon."""
    direction = quaternion.heading(state.orientation) - decision.heading_error
    forward = np.array([np.cos(direction), np.sin(direction)])
    left = np.array([-forward[1], forward[0]])
    return state.position[:2] + decision.goal_distance * forward - decision.lateral_error * left, direction
