"""One decision of the paper's learner in NumPy: Q of 81 joint actions, Boltzmann selection (3), update (19)-(21)."""

import itertools
import time

import numpy as np

UNITS, STATES, CONTROLLED = 50, 6, 4
ALPHA, GAMMA, TEMPERATURE = 0.1, 0.9, 0.5
RATE_WEIGHT, RATE_WIDTH, RATE_CENTRE = 0.1, 0.01, 0.1


class Learner:
    def __init__(self):
        self.random = np.random.default_rng(1)
        self.weight = self.random.uniform(-1, 1, UNITS)
        self.width = self.random.uniform(0.7, 1.3, UNITS)
        self.centre = self.random.uniform(0, 1, (UNITS, STATES + CONTROLLED))
        self.inputs = np.zeros((3**CONTROLLED, STATES + CONTROLLED))  # of all actions in one state
        self.inputs[:, STATES:] = list(itertools.product((0, 0.5, 1), repeat=CONTROLLED))
        self.last = self.inputs[0].copy()

    def activations(self, x):
        """phi [.., units] of (14) at the inputs x [.., inputs], and the squared distances."""
        distance = ((x[..., None, :] - self.centre) ** 2).sum(-1)
        return np.exp(-distance / self.width**2), distance

    def decide(self, states, reward):
        self.inputs[:, :STATES] = states
        q = self.activations(self.inputs)[0] @ self.weight
        likelihood = np.exp((q - q.max()) / TEMPERATURE).cumsum()
        action = np.searchsorted(likelihood, self.random.random() * likelihood[-1], side="right")
        self.learn(reward + GAMMA * q.max())
        self.last[:] = self.inputs[action]

    def learn(self, target):
        phi, distance = self.activations(self.last)
        step = ALPHA * (target - phi @ self.weight)
        pull = 2 * step * self.weight * phi / self.width**2
        self.weight += RATE_WEIGHT * step * phi
        self.width += RATE_WIDTH * pull * distance / self.width
        self.centre += RATE_CENTRE * pull[:, None] * (self.last - self.centre)


def seconds_per_decision(count=1000):
    """Processor time."""
    learner = Learner()
    states = learner.random.uniform(0, 1, (count, STATES))
    start = time.process_time()
    for k in range(count):
        learner.decide(states[k], 0.25 * (k % 7) - 0.75)
    return (time.process_time() - start) / count
