"""A simulator in a network of its own, and two sockets of that network for the process that is to talk with it.

A process with threads, such as a notebook's, cannot go into another user's namespace. A socket stays in the namespace
that it was made in, whoever holds it: so what starts in there makes the sockets and hands them out (inside.py).
"""

import contextlib
import os
import shutil
import socket
import sys
import tempfile
import warnings
from pathlib import Path
from typing import Any

from limphome_lab import network, paths
from limphome_lab.ending import Ending
from limphome_lab.run.pair import how_it_ended
from limphome_lab.run.processes import Child
from limphome_lab.runfolder import RunFolder

INSIDE = Path(__file__).with_name("inside.py")
PATIENCE_S = 30.0  # until the network is there


class PlantEnded(Ending):
    """The simulator ended when it should not have; the text has its last words."""


class Plant:
    """Simulator of the experiment in `folder`, with the random numbers of `seed`. It ends with `stop`, or else with
    the thread of this process that has made it."""

    def __init__(self, folder: RunFolder, seed: int) -> None:
        self._maker = os.getpid()
        self._logs = Path(tempfile.mkdtemp(prefix="limphome-"))
        program = [paths.program("simulator"), "--config", folder.config, "--robot", folder.robot]
        program += ["--set", f"learning.seed={seed}"]
        self._parts = contextlib.ExitStack()
        self._parts.callback(shutil.rmtree, self._logs, ignore_errors=True)
        try:
            self.url = self._start([str(word) for word in program])
        except BaseException:
            self.stop()
            raise

    def _start(self, program: list[str]) -> str:
        """Starts it; returns the URL by which this process joins its bus."""
        prefix = network.private_prefix()
        if prefix is None:
            warnings.warn("namespaces are not permitted here; using the host's network", stacklevel=2)
            url = network.lcm_url(network.host_port())
            self._run([*program, "--lcm-url", url])
            return url
        url = network.lcm_url()
        here, there = socket.socketpair()
        with here, there:
            helper = [sys.executable, "-I", "-S", str(INSIDE), str(there.fileno()), str(self._maker)]
            self._run([*prefix, *helper, *program, "--lcm-url", url], pass_fds=[there.fileno()])
            there.close()
            here.settimeout(PATIENCE_S)
            descriptors = socket.recv_fds(here, 1, 2)[1]
        if len(descriptors) != 2:
            raise PlantEnded(f"limphome-simulator has not begun:\n{self._child.log_tail()}")
        receiver, sender = descriptors
        for each in descriptors:
            os.set_inheritable(each, False)
        return f"{url}&receiver={receiver}&sender={sender}"

    def _run(self, words: list[str], **options: Any) -> None:
        self._child = Child("simulator", words, self._logs / "simulator.log", **options)
        self._parts.callback(self._child.stop)

    def check(self) -> None:
        """Raises PlantEnded where it has ended."""
        if (code := self._child.exit_code()) is not None:
            raise PlantEnded(f"limphome-simulator ended early ({how_it_ended(code)}):\n{self._child.log_tail()}")

    def stop(self) -> None:
        """Ends it, unless a copy of its maker asks for it."""
        if os.getpid() == self._maker:
            self._parts.close()
