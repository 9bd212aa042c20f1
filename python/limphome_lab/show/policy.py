"""What was learned, as values: of Q-learning max over a of Q(s, a) by (13)(14), of a planner its postures' values."""

import itertools

import numpy as np

from limphome_lab.runfolder import InputError
from limphome_lab.sealed import unseal

LEVELS = (0.0, 0.5, 1.0)  # inputs of an actuator in reverse, still and forward
TILTS = ("roll", "pitch")
TILT_RANGE = np.pi / 2  # of the inputs' 0 to 1 [rad]
STRAIGHT = 4  # the middle one of the steering errors at which a planner keeps values
PLANNED_IN = 256  # node_value is in so many parts of reward


def load(folder, actuators):
    """Network or Lattice of the policy of a run whose robot has these actuators, by name."""
    from limphome import planner_t, policy_t  # LCM is there once all is set up, and --help before

    data = folder.policy.read_bytes()
    kind = folder.settings().get("learner", "kind", fallback="q_learning")
    if kind == "planner":
        return Lattice(unseal(planner_t, data, folder.policy), actuators)
    return Network(unseal(policy_t, data, folder.policy), actuators)


class Network:
    """Of Q-learning."""

    label = "max over all actions of Q"

    def __init__(self, policy, actuators):
        self.count, units = policy.num_controlled, policy.num_units
        self.names = [*(actuators[index] for index in policy.controlled[: self.count]), *TILTS]
        self.low = np.array([*policy.input_low[: self.count], -TILT_RANGE, -TILT_RANGE])
        self.high = np.array([*policy.input_high[: self.count], TILT_RANGE, TILT_RANGE])
        self.weight, self.width = np.array(policy.weight[:units]), np.array(policy.width[:units])
        self.centre = np.array(policy.centre)[:units, : policy.num_inputs]
        self.actions = np.array(list(itertools.product(LEVELS, repeat=self.count)))

    def values(self, states):
        """Of states [n x inputs] in their units, (13)(14) at the best action of each."""
        inputs = np.clip((states - self.low) / (self.high - self.low), 0, 1)
        split = len(self.names)
        near = np.exp(-_distances(inputs, self.centre[:, :split]) / self.width**2)  # [states x units]
        acting = np.exp(-_distances(self.actions, self.centre[:, split:]) / self.width**2)  # [actions x units]
        return ((near * self.weight) @ acting.T).max(axis=1)

    def visited(self, _actuators, _states, decisions):
        """Inputs [n x inputs] of an episode's decisions, in their units."""
        seen = np.array([decision.inputs[: len(self.names)] for decision in decisions])
        return self.low + seen * (self.high - self.low)


class Lattice:
    """Of a planner: by the arm's joints, on its way straight ahead, interpolated between the nodes."""

    label = "value of the posture, straight ahead"

    def __init__(self, planner, actuators):
        joints = [k for k in range(planner.num_controlled) if planner.joint_high[k] > planner.joint_low[k]]
        self.names = [actuators[planner.controlled[k]] for k in joints[: planner.num_joints]]
        self.count = np.array(planner.node_count[: planner.num_joints])
        self.low = np.array(planner.node_low[: planner.num_joints])
        self.spacing = np.array(planner.node_spacing[: planner.num_joints])
        self.high = self.low + (self.count - 1) * self.spacing
        values = np.array(planner.node_value[: planner.num_nodes])[:, STRAIGHT] / PLANNED_IN
        self.node = values.reshape(self.count[::-1]).T  # the first joint's nodes follow one another

    def values(self, states):
        at = np.clip((states - self.low) / self.spacing, 0, self.count - 1)
        first = np.minimum(at.astype(int), np.maximum(self.count - 2, 0))
        share = at - first
        total = np.zeros(len(states))
        for corner in itertools.product((0, 1), repeat=len(self.count)):
            weight = np.prod(np.where(corner, share, 1 - share), axis=1)
            node = np.minimum(first + corner, self.count - 1)
            total += weight * self.node[tuple(node.T)]
        return total

    def visited(self, actuators, states, _decisions):
        """Angles [n x joints] in the states of an episode."""
        indices = [actuators.index(name) for name in self.names]
        return np.array([[state.actuator_position[index] for index in indices] for state in states])


def chosen(policy, words):
    """Indices of the two inputs in "roll,pitch" and the like."""
    names = [word.strip() for word in words.split(",")]
    if len(names) != 2 or names[0] == names[1] or any(name not in policy.names for name in names):
        raise InputError(f"--value-map {words}: must be two of {', '.join(policy.names)}, with a comma between them")
    return [policy.names.index(name) for name in names]


def _distances(points, centres):
    """[points x centres] squared."""
    return ((points[:, None, :] - centres[None, :, :]) ** 2).sum(axis=2)
