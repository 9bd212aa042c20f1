"""Runs the real simulation under limphome-instrument and gives back what it measures."""

import json
import math
import subprocess

import numpy as np

from limphome import ground_truth_t
from limphome_lab import paths
from limphome_lab.measure.validation.statics import GRAVITY
from limphome_lab.robot import rotation_of

PAPER = paths.CONFIG / "paper.ini"
CRAWLER = paths.CONFIG / "crawler.urdf"

LEFT_LOCKED = ("failure.actuator=left_crawler", "failure.mode=locked")
LEFT_FREE = ("failure.actuator=left_crawler", "failure.mode=free")
SOUND = ("failure.actuator=none",)
LEFT, RIGHT, SWING, BOOM, ARM = range(5)


class Report:
    """State and contacts at one moment; the fields are those of limphome-instrument's JSON."""

    def __init__(self, fields):
        self.fields = fields
        self.axes = rotation_of(fields["orientation"])

    def __getattr__(self, name):
        value = self.fields[name]
        return np.array(value) if isinstance(value, list) and name != "contacts" else value

    @property
    def heading(self):
        return math.atan2(self.axes[1, 0], self.axes[0, 0])

    @property
    def roll(self):
        """Above 0 with the left side up [rad]."""
        return math.atan2(self.axes[2, 1], self.axes[2, 2])

    def forces(self, part=None):
        """[n x 3] of the ground on the robot [N]."""
        on_ground = [c for c in self.contacts if c["with"] == ground_truth_t.GROUND]
        return np.array([c["force"] for c in on_ground if part in (None, c["part"])]).reshape(-1, 3)


class Instrument:
    """The paper's robot and experiment, but for `robot` (a URDF file) and `settings` (section.key=value)."""

    def __init__(self, settings=LEFT_LOCKED, robot=CRAWLER):
        command = [paths.program("instrument"), "--config", PAPER, "--robot", robot]
        for setting in settings:
            command += ["--set", setting]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.stdin.close()
        self.process.wait()

    def gravity(self, vector):
        self._say("gravity", vector)

    def slope(self, angle):
        """Level ground as the robot finds it that faces up a slope of `angle`."""
        self.gravity((0, -GRAVITY * math.sin(angle), -GRAVITY * math.cos(angle)))

    def lift(self, height):
        self._say("lift", [height])

    def run(self, seconds, *rates):
        """Steady commands: belt speeds [m/s], then joint rates [rad/s]."""
        self._say("command", rates)
        self._say("advance", [seconds])

    def reset(self, episode=0):
        self._say("reset", [episode])

    def report(self):
        return Report(self._ask("sense") | self._ask("truth") | self._ask("measure"))

    def turning_rate(self, seconds, *rates):
        """Mean rate of the heading from now on [rad/s], and the state at the end."""
        before = self.report()
        self.run(seconds, *rates)
        after = self.report()
        turned = math.remainder(after.heading - before.heading, 2 * math.pi)
        return turned / (after.time - before.time), after

    def _ask(self, verb):
        self._say(verb, [])
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError(f"limphome-instrument ended with exit code {self.process.wait()}")
        return json.loads(line)

    def _say(self, verb, numbers):
        self.process.stdin.write(" ".join([verb, *(repr(float(number)) for number in numbers)]) + "\n")
