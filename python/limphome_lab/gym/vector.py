"""Several environments that go on side by side, each simulator a process of its own."""

import os
import weakref
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from limphome_lab.gym.session import Experiment, Session


class LimpHomeVector(VectorEnv[np.ndarray, np.ndarray, np.ndarray]):
    """`num_envs` of `LimpHome`, which tells of actions, observations, rewards and the other arguments.

    The simulators run at the same time, while this process waits for all: there is nothing to hand from one Python to
    another, as with `gymnasium.vector.AsyncVectorEnv`. An episode that has ended is followed by the next in the step
    after (`AutoresetMode.NEXT_STEP`), of which the reward is 0.

    A whole number for a seed is that of the first, the others follow; without one environment i has the configuration's
    plus i. `options` of `reset` may have a `reset_mask` [num_envs], and `put_back`.
    """

    metadata = {"render_modes": [], "autoreset_mode": AutoresetMode.NEXT_STEP}  # noqa: RUF012

    def __init__(
        self,
        num_envs: int = 2,
        config: str | os.PathLike[str] | None = None,
        robot: str | os.PathLike[str] | None = None,
        packages: str | None = None,
        set: Mapping[str, Any] | None = None,
        line: bool = False,
    ) -> None:
        if num_envs < 1:
            raise ValueError(f"{num_envs} environments: must be at least 1")
        self.num_envs = num_envs
        self._sessions: list[Session] = []
        self._end = weakref.finalize(self, _close, self._sessions)
        experiment = Experiment(config, robot, packages, set)
        for number in range(num_envs):
            self._sessions.append(Session(experiment, line, experiment.seed + number))
        self.single_observation_space = self._sessions[0].observation_space()
        self.single_action_space = self._sessions[0].action_space()
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[np.ndarray, dict[str, Any]]:
        """Begins the next episode of all environments, or of those of the mask; returns observations and infos."""
        seeds = self._seeds(seed)
        super().reset(seed=seeds[0])
        options = options or {}
        mask = np.asarray(options.get("reset_mask", np.ones(self.num_envs)))
        if mask.shape != (self.num_envs,):
            raise ValueError(f"reset_mask of shape {mask.shape}: must be ({self.num_envs},)")
        numbers = np.flatnonzero(mask).tolist()
        for number in numbers:
            self._sessions[number].begin(seeds[number], bool(options.get("put_back")))
        observations, _, infos = self._take_in(numbers)
        return observations, infos

    def step(self, actions: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, dict[str, Any]]:
        """One decision of each; returns observations, rewards, terminations, truncations and infos."""
        fresh = [session.terminated or session.truncated for session in self._sessions]
        steps = list(zip(self._sessions, np.asarray(actions).tolist(), fresh, strict=True))
        for session, action, begins in steps:  # all, before any of them goes on
            if not begins:
                session.check(action)
        for session, action, begins in steps:
            if begins:
                session.begin()
            else:
                session.act(action)
        observations, rewards, infos = self._take_in(self._numbers())
        terminations = np.array([session.terminated for session in self._sessions])
        truncations = np.array([session.truncated for session in self._sessions])
        return observations, rewards, terminations, truncations, infos

    def _seeds(self, seed: int | Sequence[int | None] | None) -> list[int | None]:
        """Of each environment."""
        if seed is None:
            return [None] * self.num_envs
        if not isinstance(seed, Sequence):
            return [int(seed) + i for i in self._numbers()]
        seeds = list(seed)
        if len(seeds) != self.num_envs:
            raise ValueError(f"{len(seeds)} seeds: must be {self.num_envs}, or one for the first")
        return seeds

    def _numbers(self) -> range:
        return range(self.num_envs)

    def _take_in(self, numbers: Sequence[int]) -> tuple[np.ndarray, np.ndarray, dict[str, Any]]:
        """Waits for the states that were asked for; observations of all, rewards and infos of `numbers`."""
        rewards = np.zeros(self.num_envs)
        infos: dict[str, Any] = {}
        for number in numbers:
            self._sessions[number].wait()
            info = self._sessions[number].values()
            rewards[number] = info.pop("reward")
            infos = self._add_info(infos, info, number)
        return np.stack([session.inputs() for session in self._sessions]), rewards, infos

    def close_extras(self, **kwargs: Any) -> None:
        """Ends the simulators, as the end of this object or of this process does."""
        self._end()


def _close(sessions: list[Session]) -> None:
    for session in sessions:
        session.close()
