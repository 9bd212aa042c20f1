"""Where the goal line of an episode lies."""

import numpy as np
import pytest

from limphome import decision_t, robot_state_t
from limphome_lab import quaternion
from limphome_lab.goal import goal


def test_line_lies_ahead_along_the_direction_of_the_episode():
    state, decision = robot_state_t(), decision_t()
    state.position = [3.0, 4.0, 0.1]
    state.orientation = list(quaternion.about((0, 0, 1), np.radians(100)))
    decision.heading_error = np.radians(10)  # to the left of a line along +y
    decision.lateral_error = 0.25  # to its left, that is at smaller x
    decision.goal_distance = 1.5
    point, direction = goal(decision, state)
    assert direction == pytest.approx(np.pi / 2)
    assert point == pytest.approx([3.25, 5.5])
