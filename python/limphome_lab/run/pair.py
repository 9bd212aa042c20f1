"""Simulator and controller from start to clean end: as two processes on one network, or as one process on none."""

import signal
import sys
import time

from limphome_lab import paths, registry
from limphome_lab.ending import Ending
from limphome_lab.run.manifest import PROCESSES, TOGETHER, last_status
from limphome_lab.run.processes import ToldChild
from limphome_lab.run.watch import Watch, process_trouble

POLL_S = 0.05
BAD_INPUT = 2  # exit code of the programs, as of the scripts, for what the user gave
GAVE_UP = 3  # exit code of the controller that has had nothing to decide on for link.give_up_s
MOST_RESTARTS = 10  # without an episode more than there have been


class PairFailed(Ending):
    """One of them ended when it should not have; the text tells which, and shows its last words."""

    def __init__(self, child, *others):
        code = child.exit_code()
        stuck = [(other.name, process_trouble(other.process.pid)) for other in others]
        super().__init__(
            "".join(f"limphome-{name} {trouble}\n" for name, trouble in stuck if trouble)
            + f"limphome-{child.name} ended early ({how_it_ended(code)}); the end of {paths.shown(child.log)}:\n"
            f"{child.log_tail()}"
        )
        self.exit_code = BAD_INPUT if code == BAD_INPUT else 1


def how_it_ended(code):
    if code >= 0:
        return f"exit code {code}"
    try:
        return f"signal {signal.Signals(-code).name}"
    except ValueError:  # most of the real-time signals have no name
        return f"signal {-code}"


def told_by(program):
    """Whose status_t a program sends."""
    return PROCESSES if program == TOGETHER else (program,)


class Pair:
    """Use as a context: leaving it ends what it has started, whatever happened. `url`: of the network of two processes;
    None: there is none, and both are one process, which nobody can watch. `driver`: words of the program that is the
    plant in place of the simulator; `ready`: called once others can find the pair, before it starts."""

    def __init__(self, folder, url=None, controller_options=(), driver=None, ready=lambda: None):
        self.folder = folder
        self.url = url
        self.controller_options = [str(option) for option in controller_options]
        self.driver = driver
        self.ready = ready
        self.programs = [TOGETHER] if url is None else list(PROCESSES)
        self.watch = Watch(url)
        self.restarts = []  # {"process", "ended", "after_episode", "unmeasured_s"}, where it is supervised
        self._ended = {}  # {process: last status of each life that another has followed}
        self._began = {}  # {process: when its present life began [s, monotonic]}

    def __enter__(self):
        self.entry = registry.register(self.folder.path, self.url) if self.url else None
        self.children = []
        try:
            self.ready()
            if self.url:
                self.simulator = self._start("driver" if self.driver else "simulator")
            self.controller = self._start_controller(*self.controller_options)
        except BaseException:
            self.__exit__()
            raise
        return self

    def _start_controller(self, *options):
        return self._start("controller" if self.url else TOGETHER, "--out", self.folder.path, *options)

    def _start(self, name, *options):
        self._began |= dict.fromkeys(told_by(name), time.monotonic())
        common = ["--config", self.folder.config, "--robot", self.folder.robot]
        if self.url:
            common += ["--lcm-url", self.url]
        program = self.driver if name == "driver" else [paths.program(name)]
        child = ToldChild(name, [*program, *common, *options], self.folder.path / f"{name}.log")
        self.children.append(child)
        return child

    def last_statuses(self, name):
        """The last status_t that a process has told in each of its lives, as far as the recording has it."""
        ended = self._ended.get(name, [])
        last = last_status(self.folder.messages, name, self._began[name]) if name in self._began else None
        return ended if last is None else [*ended, last]

    def __exit__(self, *_):
        # the controller first, so that the simulator's end does not look like a fault to it
        for child in reversed(self.children):
            child.stop(signal.SIGINT if child is self.children[-1] else signal.SIGTERM)
        if self.entry:
            self.entry.unlink(missing_ok=True)

    def finished(self):
        """Whether the controller has done all its episodes; PairFailed where a process ended otherwise."""
        code = self.controller.exit_code()
        if code == 0:
            return True
        for child in list(self.children):
            if child.exit_code() is not None:
                self.failed(child)
        return False

    def failed(self, child):
        raise PairFailed(child, *(other for other in self.children if other is not child and other.exit_code() is None))

    def run(self, tail, progress):
        """Waits for all episodes, showing those that `tail` reads on `progress`; then ends what is left."""
        try:
            while not self.finished():
                episodes = tail.read_new()
                progress.update(episodes)
                self.look(episodes)
                time.sleep(POLL_S)
            self.end()
        finally:
            progress.update(tail.read_new())
            progress.close()

    def look(self, episodes):
        """Call often, with the episodes that have ended since; says so where a process is stuck."""
        if episodes:
            self.watch.progressed()
        self.watch.look(self.children)

    def end(self):
        """After the controller has finished: ends the simulator, which must go without complaint."""
        if self.url and self.simulator.stop() != 0:
            raise PairFailed(self.simulator)


class SupervisedPair(Pair):
    """A pair in which a process that has died is started again. A new controller goes on from the newest checkpoint;
    with a new plant the controller rolls back by itself to where the plant was last reset. It gives up where one dies
    again and again without an episode more, where the controller itself has given up, and where what the user gave is
    bad: a new one would fare no better."""

    def __enter__(self):
        self._farthest = self._fruitless = 0
        return super().__enter__()

    def look(self, episodes):
        farthest = max((episode.episode for episode in episodes), default=0)
        if farthest > self._farthest:
            self._farthest, self._fruitless = farthest, 0
        super().look(episodes)

    def end(self):
        self.children[0].stop()  # however it ends: all that was asked for is there

    def failed(self, child):
        code = child.exit_code()
        self._fruitless += 1
        if code in (BAD_INPUT, GAVE_UP) or self._fruitless > MOST_RESTARTS:
            super().failed(child)
        how = how_it_ended(code)
        self.restarts.append(
            {
                "process": child.name,
                "ended": how,
                "after_episode": self._farthest,
                "unmeasured_s": round(self._measure(child.name), 3),
            }
        )
        print(f"limphome-{child.name} ended early ({how}) and is started again", file=sys.stderr)
        self.children.remove(child)
        if child is self.controller:
            options = [option for option in self.controller_options if option != "--resume"]
            self.controller = self._start_controller("--resume", *options)
        else:
            self.simulator = self._start("simulator")
            self.children.reverse()  # it is the controller that ends first

    def _measure(self, name):
        """Keeps what a process that has ended told of itself, as the next life cuts the recording back. Returns for how
        long before it had told nothing [s]."""
        return max(self._measure_half(each) for each in told_by(name))

    def _measure_half(self, name):
        known = len(self._ended.get(name, []))
        self._ended[name] = self.last_statuses(name)
        told = self._ended[name][-1].utime / 1e6 if len(self._ended[name]) > known else self._began[name]
        return time.monotonic() - told
