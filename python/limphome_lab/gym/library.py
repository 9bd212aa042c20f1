"""The shared library liblimphome_environment (controller/environment/environment.h), by ctypes."""

import ctypes
import functools
import os
from ctypes import POINTER, c_bool, c_char_p, c_double, c_float, c_int, c_int32, c_void_p
from typing import Any

import numpy as np

from limphome_lab import paths
from limphome_lab.ending import Ending

ERROR_LENGTH = 512
MOST_INPUTS = 16  # above those of any robot
FAILED, WAITING, GOES_ON, GOAL, TUMBLE, TIMEOUT, FAULT = range(-1, 6)  # enum environment_result
OUTCOMES = {GOAL: "goal", TUMBLE: "tumble", TIMEOUT: "timeout", FAULT: "fault"}

SIGNATURES: dict[str, tuple[Any, list[Any]]] = {
    "open": (c_void_p, [c_char_p, c_char_p, c_char_p, c_bool, c_char_p]),
    "close": (None, [c_void_p]),
    "value_names": (c_char_p, []),
    "num_inputs": (c_int32, [c_void_p]),
    "num_actions": (c_int32, [c_void_p]),
    "reset": (None, [c_void_p, c_int32]),
    "act": (None, [c_void_p, c_int32]),
    "wait": (c_int, [c_void_p, c_double, POINTER(c_float), POINTER(c_double)]),
    "next": (c_bool, [c_void_p, POINTER(c_float), POINTER(c_double)]),
    "error": (c_char_p, [c_void_p]),
}


class Library:
    """Its functions, without their prefix."""

    def __init__(self) -> None:
        self._library = ctypes.CDLL(str(paths.library("environment")))
        self.names = self.value_names().decode().rstrip(",").split(",")

    def __getattr__(self, name: str) -> Any:
        """The first time that it is asked for."""
        function = getattr(self._library, f"environment_{name}")
        function.restype, function.argtypes = SIGNATURES[name]
        setattr(self, name, function)
        return function


@functools.cache
def load() -> Library:
    return Library()


class Task:
    """The task on the plant whose bus is joined by `url`. `inputs` and `values` are of the newest state."""

    def __init__(self, config: os.PathLike[str], robot: os.PathLike[str], url: str, line: bool) -> None:
        self._library = load()
        error = ctypes.create_string_buffer(ERROR_LENGTH)
        words = [os.fsencode(config), os.fsencode(robot), url.encode()]
        self._task = self._library.open(*words, line, error)
        if not self._task:
            raise Ending(error.value.decode(errors="replace"))
        self.inputs = np.zeros(MOST_INPUTS, np.float32)
        self._values = np.zeros(len(self._library.names))
        self._places = (self.inputs.ctypes.data_as(POINTER(c_float)), self._values.ctypes.data_as(POINTER(c_double)))

    @property
    def closed(self) -> bool:
        return self._task is None

    def close(self) -> None:
        if not self.closed:
            self._library.close(self._task)
            self._task = None

    @property
    def num_inputs(self) -> int:
        return self._library.num_inputs(self._task)

    @property
    def num_actions(self) -> int:
        return self._library.num_actions(self._task)

    def reset(self, episode: int) -> None:
        """Asks for the initial pose, where `episode` begins."""
        self._library.reset(self._task, episode)

    def act(self, action: int) -> None:
        """Answers the newest state."""
        self._library.act(self._task, action)

    def wait(self, timeout: float) -> int:
        """Takes in the next state; WAITING, if it has not come within `timeout` [s]."""
        result = self._library.wait(self._task, timeout, *self._places)
        if result == FAILED:
            raise Ending(self._library.error(self._task).decode(errors="replace"))
        return result

    def next_episode(self) -> bool:
        """Goes on where the robot stands, after an episode that has ended; False: it has to be put back."""
        return self._library.next(self._task, *self._places)

    def values(self) -> dict[str, Any]:
        """What the newest state tells, by name."""
        return dict(zip(self._library.names, self._values.tolist(), strict=True))
