"""Simulator and controller as two processes on one network, from start to clean end."""

import signal
import time

from limphome_lab import paths, registry
from limphome_lab.ending import Ending
from limphome_lab.run.processes import Child

POLL_S = 0.05
BAD_INPUT = 2  # exit code of both programs, as of the scripts, for what the user gave


class PairFailed(Ending):
    """One of the two ended when it should not have; the text tells which, and shows its last words."""

    def __init__(self, child):
        code = child.exit_code()
        how = f"exit code {code}" if code >= 0 else f"signal {signal.Signals(-code).name}"
        super().__init__(
            f"limphome-{child.name} ended early ({how}); the end of {paths.shown(child.log)}:\n{child.log_tail()}"
        )
        self.exit_code = BAD_INPUT if code == BAD_INPUT else 1


class Pair:
    """Use as a context: leaving it ends both processes, whatever happened."""

    def __init__(self, folder, url, controller_options=()):
        self.folder = folder
        self.url = url
        self.controller_options = [str(option) for option in controller_options]

    def __enter__(self):
        common = ["--config", self.folder.config, "--robot", self.folder.robot, "--lcm-url", self.url]
        self.entry = registry.register(self.folder.path, self.url)
        self.children = []
        self.simulator = self._start("simulator", [paths.program("simulator"), *common])
        self.controller = self._start(
            "controller", [paths.program("controller"), *common, "--out", self.folder.path, *self.controller_options]
        )
        return self

    def _start(self, name, command):
        child = Child(name, command, self.folder.path / f"{name}.log")
        self.children.append(child)
        return child

    def __exit__(self, *_):
        # the controller first, so that the simulator's end does not look like a fault to it
        for child in reversed(self.children):
            child.stop(signal.SIGINT if child.name == "controller" else signal.SIGTERM)
        self.entry.unlink(missing_ok=True)

    def finished(self):
        """Whether the controller has done all its episodes; PairFailed where either process ended otherwise."""
        code = self.controller.exit_code()
        if code == 0:
            return True
        for child in (self.simulator, self.controller):
            if child.exit_code() is not None:
                raise PairFailed(child)
        return False

    def run(self, tail, progress):
        """Waits for all episodes, showing those that `tail` reads on `progress`; then ends the simulator."""
        try:
            while not self.finished():
                progress.update(tail.read_new())
                time.sleep(POLL_S)
            self.end()
        finally:
            progress.update(tail.read_new())
            progress.close()

    def end(self):
        """After the controller has finished: ends the simulator, which must go without complaint."""
        if self.simulator.stop() != 0:
            raise PairFailed(self.simulator)
