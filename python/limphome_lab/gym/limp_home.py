"""The environment: a robot whose crawler has failed, on its way home."""

import os
import weakref
from collections.abc import Mapping
from typing import Any

import gymnasium
import numpy as np

from limphome_lab.gym.session import Experiment, Session


class LimpHome(gymnasium.Env[np.ndarray, np.int64]):
    """The task of the paper, as limphome's own learners have it, on the simulator in lockstep.

    A step is one decision: `episode.decision_period_s` of the robot's time, 0.5 s by default.

    **Action**: `Discrete(3**n)` over the n controlled actuators, which are those that have not failed: actuator k is
    digit k of the action in base 3, the lowest first; 0 reverse, 1 still, 2 forward. It is the number that decision_t
    tells, so that recorded actions can be taken as they are, and what learners by values, such as DQN, need;
    `numpy.ravel_multi_index(levels, [3] * n, order="F")` makes it of one level for each actuator.

    **Observation**: `Box(0, 1)`, the inputs of the paper's network (Table 1): of each controlled actuator its state,
    a crawler's torque or a joint's angle, each over its range, then roll and pitch over +-pi/2. With `line`, three
    more: distance to the goal line over `episode.goal_distance_m`, lateral error over +- the same, heading error over
    +-pi. The reward (9) and the end of an episode depend on these, so without them the observation is not Markov.

    **Reward**: the sum of (8), (9) and (12) and of the penalty for a tumble, with the weights of `[reward]`.

    **Ends**: terminated on the goal line and after a tumble, truncated after `episode.step_limit` decisions. `reset`
    goes on from where the robot stands, as in our own training; it is put back to its initial pose after a tumble, at
    the end of a path, each `episode.reset_every` episodes, from the middle of an episode, and with
    `options={"put_back": True}`.

    **Info**: `reward_motion`, `reward_goal`, `reward_stability`, `reward_tumble`; `stability_margin` [m];
    `goal_distance`, `lateral_error` [m] and `heading_error` [rad] from the line; `x`, `y` [m] and `heading` [rad] in
    the world; `episode_number`, `step`, `duration` [s], `heading_change` [rad] and `waypoint_distance` [m]. Where an
    episode ends `outcome`: "goal", "tumble", "timeout", or "fault" where the simulation failed.

    **Seeds**: `reset(seed=...)` begins episode 1 of that `learning.seed`: what the simulator draws at random follows
    from seed and episode alone, as in training, so that the same actions lead to the same. Without one the seed is
    that of the configuration.

    Args:
        config: experiment (INI); default config/default.ini.
        robot: robot file (URDF); default config/crawler.urdf.
        packages: folders for package:// of its meshes, separated by ":".
        set: settings over those of `config`, such as `{"failure.mode": "free", "ground.incline_along_rad": 0.1}`.
        line: whether the observation tells where the robot is on its line, too.

    Raises:
        limphome_lab.ending.InputError: for settings or a robot that the programs refuse, with their words.
    """

    metadata = {"render_modes": []}  # noqa: RUF012

    def __init__(
        self,
        config: str | os.PathLike[str] | None = None,
        robot: str | os.PathLike[str] | None = None,
        packages: str | None = None,
        set: Mapping[str, Any] | None = None,
        line: bool = False,
    ) -> None:
        self._session = Session(Experiment(config, robot, packages, set), line)
        self._end = weakref.finalize(self, self._session.close)
        self.observation_space = self._session.observation_space()
        self.action_space = self._session.action_space()

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[np.ndarray, dict[str, Any]]:
        """Begins the next episode, or with a seed the first of that; returns observation and info."""
        super().reset(seed=seed)
        self._session.begin(seed, put_back=bool((options or {}).get("put_back")))
        self._session.wait()
        info = self._session.values()
        del info["reward"]  # of no step
        return self._session.inputs(), info

    def step(self, action: int | np.int64) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        """One decision; returns observation, reward, terminated, truncated and info."""
        session = self._session
        session.act(action)
        session.wait()
        info = session.values()
        return session.inputs(), info.pop("reward"), session.terminated, session.truncated, info

    def close(self) -> None:
        """Ends the simulator, as the end of this object or of this process does."""
        self._end()
