"""Values of what was learned: the network of (13)(14) at the best action, and a planner's lattice of postures."""

import itertools
import math

import numpy as np
import pytest

from limphome import planner_t, policy_t
from limphome_lab.runfolder import InputError
from limphome_lab.show import policy

ACTUATORS = ["left_crawler", "right_crawler", "swing", "boom"]


@pytest.fixture
def message():
    """Of three units, with a crawler and a joint."""
    random = np.random.default_rng(3)
    made = policy_t()
    made.num_actuators, made.num_controlled, made.controlled = 4, 2, [1, 3] + [0] * 6
    made.input_low, made.input_high = [-1000.0, -0.6] + [0] * 6, [1000.0, 1.2] + [0] * 6
    made.num_units, made.num_inputs = 3, 6
    made.weight = list(random.normal(size=64))
    made.width = list(random.uniform(0.5, 1, 64))
    made.centre = random.uniform(0, 1, (64, 18)).tolist()
    return made


def test_value_of_a_network_is_that_of_the_best_action(message):
    network = policy.Network(message, ACTUATORS)
    assert network.names == ["right_crawler", "boom", "roll", "pitch"]
    state = [250.0, 0.3, 0.1, -0.2]
    inputs = [(250 + 1000) / 2000, 0.9 / 1.8, 0.5 + 0.1 / math.pi, 0.5 - 0.2 / math.pi]
    expected = max(
        sum(
            message.weight[j]
            * math.exp(
                -sum((x - c) ** 2 for x, c in zip([*inputs, *action], message.centre[j], strict=False))
                / message.width[j] ** 2
            )
            for j in range(3)
        )
        for action in itertools.product((0, 0.5, 1), repeat=2)
    )
    assert network.values(np.array([state, state])) == pytest.approx([expected, expected])


@pytest.fixture
def lattice():
    """Of two joints, 3 nodes by 2, with value 10 i + j at node (i, j)."""
    made = planner_t()
    made.num_controlled, made.controlled, made.num_joints = 3, [1, 2, 3] + [0] * 5, 2
    made.joint_low, made.joint_high = [0, -2, -1] + [0] * 5, [0, 2, 1] + [0] * 5
    made.node_count, made.node_low, made.node_spacing, made.num_nodes = [3, 2, 1], [-2, -1, 0], [2, 2, 0], 6
    made.node_value = [[0] * 9 for _ in range(1200)]
    for node in range(6):
        made.node_value[node][policy.STRAIGHT] = 256 * (10 * (node % 3) + node // 3)
    return policy.Lattice(made, ACTUATORS)


@pytest.mark.parametrize(
    ("angles", "value"), [((-2, -1), 0), ((0, -1), 10), ((2, 1), 21), ((1, 0), 15.5), ((9, 9), 21)]
)
def test_value_of_a_lattice_is_interpolated(lattice, angles, value):
    assert lattice.names == ["swing", "boom"]
    assert lattice.values(np.array([angles], dtype=float)) == pytest.approx([value])


@pytest.mark.parametrize("words", ["swing", "swing,swing", "swing,roll", "swing,boom,arm"])
def test_inputs_that_there_are_not_are_refused_with_those_there_are(lattice, words):
    with pytest.raises(InputError, match="must be two of swing, boom"):
        policy.chosen(lattice, words)


def test_inputs_are_found_in_the_order_that_they_are_named_in(lattice):
    assert policy.chosen(lattice, "boom, swing") == [1, 0]
