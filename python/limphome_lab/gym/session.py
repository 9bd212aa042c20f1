"""An experiment, and a plant with the task on it: what one environment and a vector of them are made of."""

import contextlib
import operator
import os
import shutil
import tempfile
import weakref
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from gymnasium import spaces
from gymnasium.error import ClosedEnvironmentError, ResetNeeded

from limphome_lab import paths, runfolder
from limphome_lab.ending import InputError
from limphome_lab.gym.library import FAULT, GOAL, GOES_ON, OUTCOMES, TIMEOUT, TUMBLE, WAITING, Task
from limphome_lab.gym.plant import Plant

LOOK_S = 0.1  # between looks whether the plant still lives
SEED_MAX = 2**31 - 1  # of [learning] seed


class Experiment:
    """Settings, robot and meshes as a run has them, checked by both programs, whose words an InputError has."""

    def __init__(
        self,
        config: str | os.PathLike[str] | None = None,
        robot: str | os.PathLike[str] | None = None,
        packages: str | None = None,
        set: Mapping[str, Any] | None = None,
    ) -> None:
        self._place = Path(tempfile.mkdtemp(prefix="limphome-"))
        weakref.finalize(self, _remove, self._place, os.getpid())
        self.folder = runfolder.create(
            self._place / "experiment",
            config or paths.CONFIG / "default.ini",
            robot or paths.CONFIG / "crawler.urdf",
            [f"{key}={value}" for key, value in (set or {}).items()],
            packages=packages,
        )
        self.folder.leave()
        settings = self.folder.settings()
        if settings["simulator"]["reset"] != "initial_pose":
            raise InputError("simulator.reset = where_it_is: an environment has to be put back; it takes initial_pose")
        if settings["safety"]["monitor"] != "off":
            raise InputError("safety.monitor = on: an environment does as it is told; it takes off")
        self.seed = int(settings["learning"]["seed"])


def _remove(place: Path, maker: int) -> None:
    if os.getpid() == maker:
        shutil.rmtree(place, ignore_errors=True)


class Session:
    """A plant with the task on it. `begin` and `act` ask for a state, `wait` takes it in; then `result`, `inputs` and
    `values` tell of it. Its owner closes it."""

    def __init__(self, experiment: Experiment, line: bool, seed: int | None = None) -> None:
        self._experiment = experiment
        self._line = line
        self._parts = contextlib.ExitStack()
        try:
            self._start(experiment.seed if seed is None else seed)
        except BaseException:
            self.close()
            raise

    def _start(self, seed: int) -> None:
        """Starts a plant of `seed`, in the place of another if there was one. Its first state tells the spaces."""
        self._parts.close()
        self._plant = Plant(self._experiment.folder, seed)
        self._parts.callback(self._plant.stop)
        self._task = Task(self._experiment.folder.config, self._experiment.folder.robot, self._plant.url, self._line)
        self._parts.callback(self._task.close)
        self.seed = seed
        self._put_back(1)
        self.wait()
        self.num_inputs = self._task.num_inputs
        self.num_actions = self._task.num_actions
        self._episode = 0
        self.result = WAITING  # no episode has been asked for

    def begin(self, seed: int | None = None, put_back: bool = False) -> None:
        """Asks for the next episode: where the robot stands, where the last one ended and the task does not ask for
        more; else, and with `put_back`, in the initial pose; with a seed, for episode 1 of that."""
        self._check_open()
        if seed is not None:
            self._begin_anew(seed)
        elif put_back or self.result not in (GOAL, TUMBLE, TIMEOUT) or not self._task.next_episode():
            self._put_back(self._episode + 1)
        else:
            self._episode += 1
            self.result = GOES_ON

    def _check_open(self) -> None:
        if self._task.closed:
            raise ClosedEnvironmentError("the environment is closed")

    def _begin_anew(self, seed: int) -> None:
        if not 0 <= seed <= SEED_MAX:
            raise InputError(f"seed {seed}: must be 0 to {SEED_MAX}, as [learning] seed")
        if seed != self.seed:
            self._start(seed)
        self._put_back(1)

    def _put_back(self, episode: int) -> None:
        self._task.reset(episode)
        self._episode = episode
        self.result = WAITING

    def check(self, action: int | np.int64) -> None:
        """Raises where it is no action, or none can be taken now."""
        self._check_open()
        if self.result != GOES_ON:
            raise ResetNeeded("the episode is over, or none has begun: call reset first")
        if not 0 <= operator.index(action) < self.num_actions:
            raise ValueError(f"action {action}: must be 0 to {self.num_actions - 1}")

    def act(self, action: int | np.int64) -> None:
        """Answers the newest state by a joint action."""
        self.check(action)
        self._task.act(operator.index(action))
        self.result = WAITING

    def wait(self) -> None:
        """Until the state has come that was asked for."""
        while self.result == WAITING:
            self.result = self._task.wait(LOOK_S)
            if self.result == WAITING:
                self._plant.check()

    def inputs(self) -> np.ndarray:
        """Of the newest state."""
        return self._task.inputs[: self.num_inputs].copy()

    def values(self) -> dict[str, Any]:
        """What the newest state tells, by name; where an episode ended there, its outcome, too."""
        values = self._task.values()
        if self.result in OUTCOMES:
            values["outcome"] = OUTCOMES[self.result]
        return values

    @property
    def terminated(self) -> bool:
        """At the goal line, or tumbled."""
        return self.result in (GOAL, TUMBLE)

    @property
    def truncated(self) -> bool:
        """The time was up, or the simulation failed."""
        return self.result in (TIMEOUT, FAULT)

    def observation_space(self) -> spaces.Box:
        return spaces.Box(0.0, 1.0, (self.num_inputs,), np.float32)

    def action_space(self) -> spaces.Discrete:
        return spaces.Discrete(self.num_actions)

    def close(self) -> None:
        """Ends the plant. More than once does no harm."""
        self.result = WAITING
        self._parts.close()
